//! The keys of a design file.

use std::collections::BTreeMap;

use texere_core::Section;
use toml::Spanned;

use super::any::Any;
use super::value::{Node, Value};
use crate::read::ReadError;
use crate::read::point_paper::RowOrder;

/// Declares tables with the keys that each may have. A table without required keys may itself be
/// left out.
macro_rules! tables {
    ($($(#[$doc:meta])* $table:ident { $($(#[$key_doc:meta])* $key:ident: $kind:ty,)* })*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub(super) struct $table { $($(#[$key_doc])* pub(super) $key: $kind,)* }

        impl Value for $table {
            fn absent() -> Option<Self> {
                Some(Self { $($key: Value::absent()?,)* })
            }

            fn read(node: &Node<'_>) -> Result<Self, ReadError> {
                let table = node.table(&[$(stringify!($key)),*])?;
                Ok(Self { $($key: node.key(table, stringify!($key))?,)* })
            }
        }
    )*};
}

tables! {
    DesignFile {
        name: Option<String>,
        weave: Option<WeaveTable>,
        knit: Option<KnitTable>,
        warp_knit: Option<WarpKnitTable>,
        cloth: ClothTable,
        finish: FinishTable,
        yarns: BTreeMap<Spanned<String>, YarnSpec>,
        warp: Option<ThreadSet>,
        weft: Option<ThreadSet>,
    }

    WeaveTable {
        notation: Option<Spanned<String>>,
        drawdown: Option<Spanned<String>>,
        wif: Option<Spanned<String>>,
        image: Option<Spanned<String>>,
        rows: Option<Spanned<RowOrder>>,
        repeat: Option<Spanned<Vec<Spanned<i64>>>>,
        colors: Option<Spanned<BTreeMap<Spanned<String>, Spanned<String>>>>,
        ends: Option<Spanned<i64>>,
        picks: Option<Spanned<i64>>,
    }

    KnitTable {
        chart: Option<Spanned<String>>,
        image: Option<Spanned<String>>,
        knitout: Option<Spanned<String>>,
        rows: Option<Spanned<RowOrder>>,
        colors: Option<Spanned<BTreeMap<Spanned<String>, Spanned<String>>>>,
        beds: Option<Spanned<i64>>,
        backing: Option<Spanned<String>>,
        repeat: Option<Spanned<Vec<Spanned<i64>>>>,
        yarns: Option<Spanned<Vec<Spanned<String>>>>,
        wales_per_cm: Option<Spanned<f64>>,
        courses_per_cm: Option<Spanned<f64>>,
        needles_per_inch: Option<Spanned<f64>>,
        loop_length_mm: Option<Spanned<f64>>,
        stitch_lengths_mm: BTreeMap<Spanned<String>, Spanned<f64>>,
        compression: Option<Spanned<f64>>,
        cells: Option<Spanned<String>>,
        float_max: Option<Spanned<i64>>,
    }

    WarpKnitTable {
        bars: Vec<BarTable>,
        wales: Spanned<i64>,
        courses: Spanned<i64>,
        repeat: Option<Spanned<Vec<Spanned<i64>>>>,
        wales_per_cm: Option<Spanned<f64>>,
        needles_per_inch: Option<Spanned<f64>>,
        draw_in: Option<Spanned<f64>>,
        courses_per_cm: Spanned<f64>,
        compression: Option<Spanned<f64>>,
        cells: Option<Spanned<String>>,
    }

    /// A guide bar.
    BarTable {
        lapping: Spanned<String>,
        step: Option<Spanned<i64>>,
        threading: Option<Spanned<Vec<Spanned<String>>>>,
        offset: Option<Spanned<i64>>,
        run_in_mm: Option<Spanned<f64>>,
        image: Option<Spanned<String>>,
        rows: Option<Spanned<RowOrder>>,
        colors: Option<Spanned<BTreeMap<Spanned<String>, Spanned<String>>>>,
    }

    /// How threads lie in woven cloth. Values of any kind are read, so that the refusal of a value
    /// of the wrong kind says what its key expects.
    ClothTable {
        shape: Option<Spanned<Any>>,
        warp_crimp: Option<Spanned<Any>>,
        selvedge: Option<Spanned<Any>>,
        jam: Option<Spanned<Any>>,
    }

    /// How yarns come to rest. Values of any kind are read, so that the refusal of a value of the
    /// wrong kind says what its key expects.
    FinishTable {
        settle: Option<Spanned<Any>>,
        rest: Option<Spanned<Any>>,
        hold: Option<Spanned<Any>>,
        press: Option<Spanned<Any>>,
        tension: Option<Spanned<Any>>,
        length: Option<Spanned<Any>>,
        warp_tension: Option<Spanned<Any>>,
        weft_tension: Option<Spanned<Any>>,
        calender: Option<Spanned<Any>>,
        stretch_warp: Option<Spanned<Any>>,
        stretch_weft: Option<Spanned<Any>>,
    }

    YarnSpec {
        diameter_mm: Option<Spanned<f64>>,
        tex: Option<Spanned<f64>>,
        cotton_count: Option<Spanned<f64>>,
        density: Option<Spanned<f64>>,
        fibre: Option<Spanned<String>>,
        packing: Option<Spanned<f64>>,
        least_area: Option<Spanned<f64>>,
        color: Option<Spanned<String>>,
        section: Option<Spanned<Section>>,
        plies: Option<Spanned<i64>>,
        valley: Option<Spanned<f64>>,
        flatness: Option<Spanned<f64>>,
        stiffness: Option<Spanned<f64>>,
        bending_stiffness: Option<Spanned<f64>>,
        firmness: Option<Spanned<f64>>,
        twist_per_m: Option<Spanned<f64>>,
        hairiness: Option<Spanned<f64>>,
    }

    ThreadSet {
        yarns: Spanned<Vec<Spanned<String>>>,
        per_cm: Option<Spanned<f64>>,
        per_inch: Option<Spanned<f64>>,
        /// A number, or a list of numbers that repeats over the threads.
        spacing_mm: Option<Spanned<Any>>,
    }
}

impl Value for Section {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        let table = node.any_table()?;
        let shape: Spanned<String> = node.key(table, "shape")?;
        let own = |keys: &[&str]| node.only(table, &[&["shape"], keys].concat());
        match shape.as_ref().as_str() {
            "circle" => own(&[]).map(|()| Self::Circle),
            "ellipse" => {
                own(&["aspect"])?;
                Ok(Self::Ellipse { aspect: node.key(table, "aspect")? })
            }
            "lenticular" => {
                own(&["aspect", "distortion"])?;
                let distortion: Option<f32> = node.key(table, "distortion")?;
                let distortion = distortion.unwrap_or_default();
                Ok(Self::Lenticular { aspect: node.key(table, "aspect")?, distortion })
            }
            "power-ellipse" => {
                own(&["aspect", "exponent"])?;
                Ok(Self::PowerEllipse {
                    aspect: node.key(table, "aspect")?,
                    exponent: node.key(table, "exponent")?,
                })
            }
            "polygon" => {
                own(&["corners"])?;
                Ok(Self::Polygon(node.key(table, "corners")?))
            }
            _ => Err(node
                .unfit("shape = \"circle\", \"ellipse\", \"lenticular\", \"power-ellipse\" or \"polygon\"")),
        }
    }
}

impl Value for RowOrder {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        match node.text() {
            Some("last-pick-first") => Ok(Self::LastPickFirst),
            Some("first-pick-first") => Ok(Self::FirstPickFirst),
            _ => Err(node.unfit("\"last-pick-first\" or \"first-pick-first\"")),
        }
    }
}
