//! The report as Markdown.

use std::fmt::Write;
use std::time::Duration;

use super::results::{Cloth, Column, PICTURE, Run};
use crate::phases::Phases;

/// The triangles per second that the paper states for its largest cloth, on its GPU and on its CPU.
const PAPER: [(&str, f64); 2] = [("the paper, RTX 5070 Ti", 37.99e6), ("the paper, i7-8700K", 3.84e6)];

pub(super) fn report(
    heading: &str,
    cloths: &[Cloth],
    columns: &[Column],
    phases: &[Phases],
    rounds: usize,
) -> String {
    let mut text = String::from("# Benchmarks\n\n");
    // Writing to a string can't fail.
    let _ = writeln!(
        text,
        "{heading}\n\nThe paper's cloth, K = 1, six sides, indexed, upright, no caps. Stages are medians of {rounds} warm runs, by the device's own clock where it has one; everything else is by \
         the host's.\n\n## Devices\n"
    );
    devices(&mut text, columns);
    sizes(&mut text, cloths);
    times(&mut text, cloths, columns);
    once(&mut text, columns);
    beside(&mut text, cloths, columns);
    if !phases.is_empty() {
        let [width, height] = PICTURE;
        let _ = writeln!(
            text,
            "\n## Figure 5: phases, ms\n\nGeometry on one core of the CPU and on the device that draws, what each has to \
             send there, and drawing the face, {width} x {height} pixels of four by four samples, with its light.\n\n\
             ![Geometry, buffers, drawing](figure-5.svg)\n"
        );
        text.push_str(&self::phases(cloths, phases));
    }
    text.push_str("\n## Figure 6: devices\n\n![Both stages on every device](figure-6.svg)\n");
    text
}

fn devices(text: &mut String, columns: &[Column]) {
    table(text, &["name", "device", "driver", "work is split", "timed by"], |rows| {
        for Column { info, .. } in columns {
            let clock = if info.timed_by_device { "the device" } else { "the host" };
            rows.push(
                vec![&*info.name, &*info.device, &*info.driver, &info.schedule.to_string(), clock]
                    .into_iter()
                    .map(Into::into)
                    .collect(),
            );
        }
    });
}

/// Writes table 1, the cloths.
fn sizes(text: &mut String, cloths: &[Cloth]) {
    text.push_str("\n## Table 1: the cloths\n\n");
    table(text, &["cloth", "yarns", "control points", "rings", "triangles", "bytes"], |rows| {
        for Cloth { name, counts, .. } in cloths {
            let counts =
                [counts.yarns, counts.control_points, counts.rings, counts.triangles, counts.bytes()];
            rows.push([name.clone()].into_iter().chain(counts.map(|count| count.to_string())).collect());
        }
    });
}

/// Writes table 2, the times of the stages.
fn times(text: &mut String, cloths: &[Cloth], columns: &[Column]) {
    text.push_str(
        "\n## Table 2: time of the stages, ms\n\nAlgorithms 1 and 3 are the paper's serial ones, 2 and 4 its \
                   parallel ones. The schedule per-ring and `cpu` run both stages as one.\n\n",
    );
    let stages_of = ["trajectory (1, 2)", "mesh (3, 4)", "both"];
    let titles = [&["cloth", "device"], &stages_of[..], &["million triangles/s", "times the first"]].concat();
    table(text, &titles, |rows| {
        for (number, cloth) in cloths.iter().enumerate() {
            let first = columns.first().and_then(|column| column.runs.get(number)).map(|run| run.whole);
            for Column { info, runs, .. } in columns {
                rows.push(stages(cloth, &info.name, &runs[number], first));
            }
            if number + 1 == cloths.len() {
                for (name, rate) in PAPER {
                    let time = Duration::from_secs_f64(cloth.counts.triangles as f64 / rate);
                    let mut row = vec![cloth.name.clone(), name.into(), "-".into(), "-".into(), ms(time)];
                    row.extend([format!("{:.2}", rate / 1e6), "-".into()]);
                    rows.push(row);
                }
            }
        }
    });
}

/// Writes the part of table 3 with the times of a device, once for all cloths.
fn once(text: &mut String, columns: &[Column]) {
    text.push_str(
        "\n## Table 3: what comes on top, ms\n\nOnce for all cloths: a context (the first of a driver pays for the \
                   driver), and compiling the kernels, which drivers keep from run to run.\n\n",
    );
    table(text, &["device", "context", "build"], |rows| {
        for Column { info, context, build, .. } in columns {
            rows.push(vec![info.name.clone(), context.map_or("-".into(), ms), ms(*build)]);
        }
    });
}

/// Writes the part of table 3 with the times of each cloth beside its stages.
fn beside(text: &mut String, cloths: &[Cloth], columns: &[Column]) {
    text.push_str(
        "\nFor each cloth: memory and tables, control points to the device, the mesh to the host, and giving memory \
                   back. The first mesh is the time from the open device to a mesh in its memory, all that comes first \
                   included.\n\n",
    );
    let titles =
        ["cloth", "device", "creation", "upload", "first mesh", "mesh to the host", "GB/s", "clean-up"];
    table(text, &titles, |rows| {
        for (number, cloth) in cloths.iter().enumerate() {
            for Column { info, runs, .. } in columns {
                let run = &runs[number];
                let rate = run.readback.map_or("-".into(), |time| {
                    format!("{:.1}", cloth.counts.bytes() as f64 / time.as_secs_f64() / 1e9)
                });
                rows.push(vec![
                    cloth.name.clone(),
                    info.name.clone(),
                    ms(run.creation),
                    ms(run.upload),
                    ms(run.first),
                    run.readback.map_or("-".into(), ms),
                    rate,
                    ms(run.clean_up),
                ]);
            }
        }
    });
}

/// The table of figure 5, ms.
pub(super) fn phases(cloths: &[Cloth], phases: &[Phases]) -> String {
    let mut text = String::new();
    table(&mut text, &[&["cloth"], &Phases::NAMES[..]].concat(), |rows| {
        for (cloth, phases) in cloths.iter().zip(phases) {
            rows.push([cloth.name.clone()].into_iter().chain(phases.in_order().map(ms)).collect());
        }
    });
    text
}

fn stages(cloth: &Cloth, device: &str, run: &Run, first: Option<Duration>) -> Vec<String> {
    let stage = |time: Option<Duration>| time.map_or("-".into(), ms);
    let rate = cloth.counts.triangles as f64 / run.whole.as_secs_f64() / 1e6;
    let ratio =
        first.map_or("-".into(), |first| format!("{:.1}", first.as_secs_f64() / run.whole.as_secs_f64()));
    vec![
        cloth.name.clone(),
        device.into(),
        stage(run.staged.map(|staged| staged.trajectory)),
        stage(run.staged.map(|staged| staged.mesh)),
        ms(run.whole),
        format!("{rate:.2}"),
        ratio,
    ]
}

fn ms(time: Duration) -> String {
    format!("{:.3}", time.as_secs_f64() * 1e3)
}

fn table(text: &mut String, titles: &[&str], fill: impl FnOnce(&mut Vec<Vec<String>>)) {
    let mut rows = Vec::new();
    fill(&mut rows);
    let _ = writeln!(text, "| {} |\n|{}", titles.join(" | "), "---|".repeat(titles.len()));
    for row in rows {
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
}
