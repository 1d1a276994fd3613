//! A weft knit as a program of a knitting machine, knitout 2.

use std::io::Write;

use texere_core::Section;
use texere_fabric::weft::{CarrierSet, Cells, Gauge, Instruction, KnitYarn, Knitted, Operation, Program};

use super::super::WriteError;
use super::super::target::Target;
use super::finish::KnitFinish;
use super::format::KNITOUT_FILE as FORMAT;
use super::knitted::knitted;
use super::text::{Text, named, nearest};
use crate::Design;
use crate::read::{
    Drawn, KNITOUT_BYTES_MAX, KNITOUT_PER_INCH, KnittedFrom, ProgramHead, StitchSize, file_name, is_swg,
    knitout_gauge, knitout_text, knitout_yarns,
};

/// Length of an inch, mm.
const INCH_MM: f64 = 25.4;

/// The contents of a knitout file, checked.
pub(super) struct KnitoutFile<'a> {
    program: &'a Program,
    head: &'a ProgramHead,
    /// Number of needles to the inch, or none if no reader takes that number.
    gauge: Option<f64>,
    /// The text about the yarn in each carrier.
    yarns: Vec<Option<String>>,
    /// The parts of the design that the file does not hold.
    pub(super) left_out: Vec<String>,
}

impl<'a> KnitoutFile<'a> {
    pub(super) fn new(design: &'a Design) -> Result<Self, WriteError> {
        let (knit, from) = knitted(FORMAT, design)?;
        let Drawn::Lines { file, head } = &from.drawn else {
            let what = "a repeat, which goes on beyond its edges; a design file holds it".into();
            return Err(WriteError::Unheld { format: FORMAT, what });
        };
        let wale_mm = knit.gauge().wale_mm;
        let (needles, _) = nearest(INCH_MM / wale_mm, |needles| Gauge::plain(needles).wale_mm == wale_mm);
        let [low, high] = KNITOUT_PER_INCH;
        let gauge = Some(needles).filter(|needles| (low..=high).contains(needles));
        let carriers = &from.program.carriers;
        let yarns = yarn_texts(carriers, knit);
        let mut left_out = Vec::new();
        if design.name != file_name(file) {
            left_out.push("name: a knitout file has no title".into());
        }
        let read = knitout_gauge(gauge);
        left_out.extend(beyond_gauge(knit, from, read));
        left_out.extend(beyond_yarns(knit, carriers, &yarns, read));
        if !design.settle {
            left_out.push("finish.settle: a knitout file comes to rest".into());
        }
        let finish = KnitFinish::new(design);
        left_out.extend(finish.keys.iter().map(|(key, _)| format!("finish.{key}")));
        left_out.extend(finish.unsaid);
        Ok(Self { program: &from.program, head, gauge, yarns, left_out })
    }

    pub(super) fn write<W: Write>(&self, target: Target<W>) -> Result<Target<W>, WriteError> {
        let mut text = Text::new(target, FORMAT, KNITOUT_BYTES_MAX);
        let ProgramHead { machine, position, sizes } = self.head;
        let carriers = &self.program.carriers;
        text.line(";!knitout-2")?;
        if let Some(machine) = machine {
            text.line(&format!(";;Machine: {machine}"))?;
        }
        if let Some(needles) = self.gauge {
            text.line(&format!(";;Gauge: {needles}"))?;
        }
        text.line(&format!(";;Carriers: {}", carriers.join(" ")))?;
        for (carrier, yarn) in carriers.iter().zip(&self.yarns) {
            if let Some(yarn) = yarn {
                text.line(&format!(";;Yarn-{carrier}: {yarn}"))?;
            }
        }
        if let Some(position) = position {
            text.line(&format!(";;Position: {position}"))?;
        }
        let mut sizes = sizes.iter();
        for operation in &self.program.operations {
            self.operation(&mut text, operation, &mut sizes)?;
        }
        Ok(text.end())
    }

    fn operation<W: Write>(
        &self,
        text: &mut Text<W>,
        operation: &Operation,
        sizes: &mut std::slice::Iter<'_, StitchSize>,
    ) -> Result<(), WriteError> {
        match operation.instruction {
            Instruction::LoopLength(_) => match sizes.next() {
                Some(StitchSize::Number(number)) => text.put(&format!("x-stitch-number {number}"))?,
                Some(StitchSize::Drawn([first, second])) => text.put(&format!("stitch {first} {second}"))?,
                // Each operation of this kind has a size.
                None => {}
            },
            Instruction::Rack(rack) => text.put(&format!("rack {}", self.rack(rack)))?,
            instruction => text.put(&instruction.to_string())?,
        }
        let CarrierSet(set) = operation.carriers;
        for &carrier in self.program.carrier_sets.get(set as usize).into_iter().flatten() {
            text.put(" ")?;
            text.put(&self.program.carriers[carrier as usize])?;
        }
        text.put("\n")
    }

    /// A rack as a knitout file for the program's machine writes it.
    fn rack(&self, rack: f64) -> f64 {
        let whole = rack.floor();
        let is_half = rack != whole;
        match &self.head.machine {
            Some(machine) if is_half && !is_swg(machine) => whole + 0.5,
            // The standard itself has quarters.
            _ if is_half => whole + 0.25,
            _ => rack,
        }
    }
}

/// The text about the yarn in each carrier. A reader names the yarn by the carrier and this text.
fn yarn_texts(carriers: &[String], knit: &Knitted) -> Vec<Option<String>> {
    let text = |(carrier, yarn): (&String, &KnitYarn)| {
        let name = &knit.materials()[yarn.material as usize].name;
        // The name of a header ends at its first colon.
        if name == carrier || carrier.contains(':') {
            return None;
        }
        let own = name.strip_prefix(carrier.as_str()).and_then(|rest| rest.strip_prefix(": "));
        Some(knitout_text(own.unwrap_or(name)).trim().to_owned())
    };
    carriers.iter().zip(knit.carriers()).map(text).collect()
}

/// The keys of `[knit]` that a knitout file leaves out. `read` is the gauge that a reader of the
/// file gets.
fn beyond_gauge(knit: &Knitted, from: &KnittedFrom, read: Gauge) -> Vec<String> {
    let own = knit.gauge();
    let has_length =
        |operation: &Operation| matches!(operation.instruction, Instruction::LoopLength(Some(_)));
    named(&[
        (own.wale_mm != read.wale_mm, "knit.wales_per_cm"),
        (own.course_mm != read.course_mm, "knit.courses_per_cm: a course is read as 0.76 of a wale high"),
        (own.loop_length_mm.is_some(), "knit.loop_length_mm"),
        (from.program.operations.iter().any(has_length), "knit.stitch_lengths_mm"),
        (knit.cells() != Cells::Round, "knit.cells"),
        (from.float_max.is_some(), "knit.float_max"),
    ])
}

/// The keys of `[yarns]` that a knitout file leaves out, and the first name that it changes. `read`
/// is the gauge that a reader of the file gets.
fn beyond_yarns(knit: &Knitted, carriers: &[String], texts: &[Option<String>], read: Gauge) -> Vec<String> {
    let (threads, materials) = knitout_yarns(carriers, texts, read);
    let own = |yarn: &KnitYarn| &knit.materials()[yarn.material as usize];
    let pairs = || knit.carriers().iter().zip(threads.iter().zip(&materials));
    let any = |unlike: &dyn Fn(&KnitYarn, f32, &texere_core::Material) -> bool| {
        pairs().any(|(yarn, (thread, material))| unlike(yarn, thread.radius_mm, material))
    };
    let renamed = pairs().find(|(yarn, (_, material))| own(yarn).name != material.name);
    let renamed = renamed.map(|(yarn, (_, material))| {
        format!("names of yarns that can't be kept: {:?} becomes {:?}", own(yarn).name, material.name)
    });
    let keys = named(&[
        (any(&|yarn, radius_mm, _| yarn.radius_mm != radius_mm), "yarns.diameter_mm"),
        (any(&|yarn, _, material| own(yarn).srgb != material.srgb), "yarns.color"),
        (any(&|yarn, _, material| own(yarn).tex != material.tex), "yarns.tex"),
        (any(&|yarn, _, material| own(yarn).hairiness != material.hairiness), "yarns.hairiness"),
        (any(&|yarn, _, material| own(yarn).bending != material.bending), "yarns.bending_stiffness"),
        (any(&|yarn, _, _| yarn.twist != 0.0), "yarns.twist_per_m"),
        (any(&|yarn, _, _| knit.sections()[yarn.section as usize] != Section::Circle), "yarns.section"),
    ]);
    renamed.into_iter().chain(keys).collect()
}
