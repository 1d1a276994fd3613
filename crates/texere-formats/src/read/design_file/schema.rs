//! The keys of a design file, and how to find the line that a fault stands on.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use texere_fabric::{FabricError, Weave};
use toml::Spanned;

use crate::read::error::{said, shown};
use crate::read::point_paper::RowOrder;
use crate::read::{Place, ReadError};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DesignFile {
    pub(super) name: Option<String>,
    pub(super) weave: Option<WeaveTable>,
    pub(super) knit: Option<KnitTable>,
    pub(super) warp_knit: Option<WarpKnitTable>,
    #[serde(default)]
    pub(super) cloth: ClothTable,
    #[serde(default)]
    pub(super) finish: FinishTable,
    #[serde(default)]
    pub(super) yarns: BTreeMap<String, YarnSpec>,
    pub(super) warp: Option<ThreadSet>,
    pub(super) weft: Option<ThreadSet>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WeaveTable {
    pub(super) notation: Option<Spanned<String>>,
    pub(super) drawdown: Option<Spanned<String>>,
    pub(super) wif: Option<Spanned<String>>,
    pub(super) image: Option<Spanned<String>>,
    pub(super) rows: Option<Spanned<RowOrder>>,
    pub(super) repeat: Option<Spanned<Vec<Spanned<i64>>>>,
    pub(super) colors: Option<Spanned<BTreeMap<Spanned<String>, Spanned<String>>>>,
    pub(super) ends: Option<Spanned<i64>>,
    pub(super) picks: Option<Spanned<i64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KnitTable {
    pub(super) chart: Option<Spanned<String>>,
    pub(super) image: Option<Spanned<String>>,
    pub(super) knitout: Option<Spanned<String>>,
    pub(super) rows: Option<Spanned<RowOrder>>,
    pub(super) colors: Option<Spanned<BTreeMap<Spanned<String>, Spanned<String>>>>,
    pub(super) beds: Option<Spanned<i64>>,
    pub(super) backing: Option<Spanned<String>>,
    pub(super) repeat: Option<Spanned<Vec<Spanned<i64>>>>,
    pub(super) yarns: Option<Spanned<Vec<Spanned<String>>>>,
    pub(super) wales_per_cm: Option<Spanned<f64>>,
    pub(super) courses_per_cm: Option<Spanned<f64>>,
    pub(super) needles_per_inch: Option<Spanned<f64>>,
    pub(super) loop_length_mm: Option<Spanned<f64>>,
    #[serde(default)]
    pub(super) stitch_lengths_mm: BTreeMap<Spanned<String>, Spanned<f64>>,
    pub(super) compression: Option<Spanned<f64>>,
    pub(super) cells: Option<Spanned<String>>,
    pub(super) float_max: Option<Spanned<i64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WarpKnitTable {
    pub(super) bars: Vec<BarTable>,
    pub(super) wales: Spanned<i64>,
    pub(super) courses: Spanned<i64>,
    pub(super) repeat: Option<Spanned<Vec<Spanned<i64>>>>,
    pub(super) wales_per_cm: Option<Spanned<f64>>,
    pub(super) needles_per_inch: Option<Spanned<f64>>,
    pub(super) draw_in: Option<Spanned<f64>>,
    pub(super) courses_per_cm: Spanned<f64>,
    pub(super) compression: Option<Spanned<f64>>,
    pub(super) cells: Option<Spanned<String>>,
}

/// A guide bar.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BarTable {
    pub(super) lapping: Spanned<String>,
    pub(super) step: Option<Spanned<i64>>,
    pub(super) threading: Option<Spanned<Vec<Spanned<String>>>>,
    pub(super) offset: Option<Spanned<i64>>,
    pub(super) run_in_mm: Option<Spanned<f64>>,
    pub(super) image: Option<Spanned<String>>,
    pub(super) rows: Option<Spanned<RowOrder>>,
    pub(super) colors: Option<Spanned<BTreeMap<Spanned<String>, Spanned<String>>>>,
}

/// How threads lie. Values of any kind, so that one of the wrong kind is refused with its key.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClothTable {
    pub(super) shape: Option<Spanned<toml::Value>>,
    pub(super) warp_crimp: Option<Spanned<toml::Value>>,
    pub(super) selvedge: Option<Spanned<toml::Value>>,
    pub(super) jam: Option<Spanned<toml::Value>>,
}

/// How yarns come to rest. Values of any kind, likewise.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FinishTable {
    pub(super) settle: Option<Spanned<toml::Value>>,
    pub(super) press: Option<Spanned<toml::Value>>,
    pub(super) tension: Option<Spanned<toml::Value>>,
    pub(super) length: Option<Spanned<toml::Value>>,
    pub(super) warp_tension: Option<Spanned<toml::Value>>,
    pub(super) weft_tension: Option<Spanned<toml::Value>>,
    pub(super) calender: Option<Spanned<toml::Value>>,
    pub(super) stretch_warp: Option<Spanned<toml::Value>>,
    pub(super) stretch_weft: Option<Spanned<toml::Value>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct YarnSpec {
    pub(super) diameter_mm: Option<Spanned<f64>>,
    pub(super) tex: Option<Spanned<f64>>,
    pub(super) cotton_count: Option<Spanned<f64>>,
    pub(super) density: Option<Spanned<f64>>,
    pub(super) color: Option<Spanned<String>>,
    pub(super) section: Option<Spanned<SectionSpec>>,
    pub(super) plies: Option<Spanned<i64>>,
    pub(super) flatness: Option<Spanned<f64>>,
    pub(super) stiffness: Option<Spanned<f64>>,
    pub(super) twist_per_m: Option<Spanned<f64>>,
    pub(super) hairiness: Option<Spanned<f64>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "shape", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum SectionSpec {
    Circle,
    Ellipse {
        aspect: f32,
    },
    Lenticular {
        aspect: f32,
        #[serde(default)]
        distortion: f32,
    },
    PowerEllipse {
        aspect: f32,
        exponent: f32,
    },
    Polygon {
        corners: Vec<[f32; 2]>,
    },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ThreadSet {
    pub(super) yarns: Spanned<Vec<Spanned<String>>>,
    pub(super) per_cm: Option<Spanned<f64>>,
    pub(super) per_inch: Option<Spanned<f64>>,
    /// A number, or a list of numbers that is repeated over the threads.
    pub(super) spacing_mm: Option<Spanned<toml::Value>>,
}

/// Most threads of a warp or weft.
const THREAD_LIMIT: i64 = 1_000_000;

/// A design file's text and where it came from.
#[derive(Debug)]
pub(super) struct Source<'a> {
    pub(super) path: &'a Path,
    text: &'a str,
}

impl<'a> Source<'a> {
    pub(super) fn new(path: &'a Path, bytes: &'a [u8]) -> Result<Self, ReadError> {
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
            ReadError::Syntax { file: path.into(), line, message: "not UTF-8".into() }
        })?;
        Ok(Self { path, text })
    }

    /// The path of a file that the design names: it lies beside the design.
    pub(super) fn beside(&self, file: &Spanned<String>) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(file.as_ref())
    }

    pub(super) fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, ReadError> {
        toml::from_str(self.text).map_err(|mut error| {
            let span = error.span().unwrap_or(0..0);
            let message = error.message().to_owned();
            if let Some((key, nearest)) = unknown_field(&message) {
                let place = self.place(&format!("key \"{}\"", shown(&key)), span);
                return ReadError::UnknownKey { place, nearest };
            }
            // Without its input, an error ends with the keys that lead to the value.
            error.set_input(None);
            let told = error.to_string();
            let field = told.trim_end().rsplit_once("\nin `").and_then(|(_, keys)| keys.strip_suffix('`'));
            match (field, expected_instead(&message)) {
                (Some(field), Some(expected)) => self.unfit(field, span, &expected),
                (Some(field), None) => {
                    ReadError::Value { place: self.place(field, span), message: said(&message) }
                }
                (None, _) => ReadError::Syntax {
                    file: self.path.into(),
                    line: self.line(span),
                    message: said(&message),
                },
            }
        })
    }

    /// A value as the file has it, without its quotes.
    fn written(&self, span: Range<usize>) -> String {
        shown(self.text.get(span).unwrap_or_default().trim_matches(['"', '\'']))
    }

    fn line(&self, span: Range<usize>) -> usize {
        self.text.bytes().take(span.start).filter(|&byte| byte == b'\n').count() + 1
    }

    pub(super) fn place(&self, field: &str, span: Range<usize>) -> Place {
        Place::new(self.path, self.line(span), field)
    }

    pub(super) fn bad<T: ToString>(&self, field: &str, value: &Spanned<T>, expected: &str) -> ReadError {
        let (place, value) = (self.place(field, value.span()), shown(&value.as_ref().to_string()));
        ReadError::BadValue { place, value, expected: expected.into() }
    }

    /// The refusal of a value that is not even of the right kind: it is shown as the file has it.
    pub(super) fn odd(&self, field: &str, value: &Spanned<toml::Value>, expected: &str) -> ReadError {
        self.unfit(field, value.span(), expected)
    }

    /// The refusal of what stands at `span`, shown as the file has it.
    pub(super) fn unfit(&self, field: &str, span: Range<usize>, expected: &str) -> ReadError {
        let (place, value) = (self.place(field, span.clone()), self.written(span));
        ReadError::BadValue { place, value, expected: expected.into() }
    }

    /// A number of any size, whole or not.
    pub(super) fn float(
        &self,
        field: &str,
        value: &Spanned<toml::Value>,
        expected: &str,
    ) -> Result<Spanned<f64>, ReadError> {
        let number = real(value.as_ref()).ok_or_else(|| self.odd(field, value, expected))?;
        Ok(Spanned::new(value.span(), number))
    }

    /// A number above 0 (or of either sign, where `low` is negative) within its limits.
    pub(super) fn number(
        &self,
        field: &str,
        value: &Spanned<f64>,
        low: f64,
        high: f64,
    ) -> Result<f64, ReadError> {
        if (low..=high).contains(value.as_ref()) {
            return Ok(*value.as_ref());
        }
        Err(ReadError::OutOfRange {
            place: self.place(field, value.span()),
            value: *value.as_ref(),
            low,
            high,
        })
    }

    /// A number of threads.
    pub(super) fn count(&self, field: &str, value: &Spanned<i64>) -> Result<usize, ReadError> {
        self.integer(field, value, 1, THREAD_LIMIT).map(|count| count as usize)
    }

    pub(super) fn integer(
        &self,
        field: &str,
        value: &Spanned<i64>,
        low: i64,
        high: i64,
    ) -> Result<u32, ReadError> {
        let number = *value.as_ref();
        match u32::try_from(number) {
            Ok(fits) if (low..=high).contains(&number) => Ok(fits),
            _ => {
                let (place, value) = (self.place(field, value.span()), number as f64);
                Err(ReadError::OutOfRange { place, value, low: low as f64, high: high as f64 })
            }
        }
    }

    /// A colour as `#rrggbb`.
    pub(super) fn rgb(&self, field: &str, color: &Spanned<String>) -> Result<[u8; 3], ReadError> {
        let is_hex =
            |digits: &&str| digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let digits = color.as_ref().strip_prefix('#').filter(is_hex);
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let [_, red, green, blue] =
            value.ok_or_else(|| self.bad(field, color, "a colour like #26406e"))?.to_be_bytes();
        Ok([red, green, blue])
    }

    pub(super) fn weave(&self, field: &str, notation: &Spanned<String>) -> Result<Weave, ReadError> {
        let weave = Weave::parse(notation.as_ref());
        weave.map_err(|source| ReadError::Weave { place: self.place(field, notation.span()), source })
    }

    pub(super) fn fabric(&self, source: FabricError) -> ReadError {
        ReadError::fabric(self.path, source)
    }
}

/// A number, written with a point or without.
pub(super) fn real(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// The unknown key that serde complains of, and the known one nearest to it: its message lists them in backquotes.
fn unknown_field(message: &str) -> Option<(String, Option<String>)> {
    let rest = message.strip_prefix("unknown field `")?;
    // The list that follows has no backquote but those round its keys; the unknown key may have any.
    let (key, list) = rest.rsplit_once("`, expected ")?;
    // Further apart than a third of its letters, a key is another word, not a misspelling. One much longer than all
    // known ones is that without being compared letter by letter.
    let most = |known: &str| known.len().max(3) / 3 + 1;
    let nearest = list
        .split('`')
        .skip(1)
        .step_by(2)
        .filter(|known| key.len() <= known.len() + 4 * most(known))
        .map(|known| (strsim::damerau_levenshtein(key, known), known))
        .filter(|(distance, known)| *distance <= most(known))
        .min();
    Some((key.into(), nearest.map(|(_, known)| known.into())))
}

/// What should have stood where a value of the wrong kind stands, in a designer's words for serde's.
fn expected_instead(message: &str) -> Option<String> {
    let (_, expected) = message.strip_prefix("invalid type: ")?.rsplit_once(", expected ")?;
    Some(match expected {
        "i64" => "a whole number".into(),
        "f64" | "f32" => "a number".into(),
        "a string" => "text in quotes".into(),
        "a sequence" | "a tuple" => "a list".into(),
        "a map" => "a table".into(),
        other if other.starts_with("struct ") || other.starts_with("internally tagged enum ") => {
            "a table".into()
        }
        other => shown(other),
    })
}
