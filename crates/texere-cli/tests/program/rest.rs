//! The command line and the library make the same cloth of a design.

use texere::rest::RestReport;
use texere::{Pipeline, Settings};

use crate::{stderr, texere};

/// Three small designs: a weave that is stretched before it comes to rest, a knit and a warp knit.
pub(crate) const DESIGNS: [(&str, &str); 3] = [
    (
        "weave",
        "weave = { notation = \"2/1\", ends = 6, picks = 6 }\nyarns.a.diameter_mm = 0.143\n\
         warp = { yarns = [\"a\"], spacing_mm = 0.3 }\nweft = { yarns = [\"a\"], spacing_mm = 0.35 }\n\
         finish.stretch_weft = 1.01\n",
    ),
    ("knit", "knit = { chart = \"k\", repeat = [3, 3], loop_length_mm = 5.0 }\nyarns.a.diameter_mm = 0.3\n"),
    (
        "warp-knit",
        "[warp_knit]\nwales = 3\ncourses = 4\nwales_per_cm = 10\ncourses_per_cm = 13\n[[warp_knit.bars]]\n\
         lapping = \"1-0/1-2//\"\n[[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\n[yarns.a]\ndiameter_mm = 0.1\n",
    ),
];

#[test]
fn the_library_and_the_program_make_the_same_mesh_of_a_design() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in DESIGNS {
        let path = folder.path().join(name).with_extension("toml");
        let [own, other] = ["own", "other"].map(|which| folder.path().join(format!("{name}-{which}.ply")));
        std::fs::write(&path, text).unwrap();

        let design = texere::read(&path).unwrap();
        let device = texere::open("cpu").unwrap();
        let cloth = design.rest(&*device).run().unwrap();
        assert!(matches!(cloth.report(), RestReport::Finished(_)), "{name}: {}", cloth.report());
        let placed = cloth.design().yarns().unwrap();
        assert_ne!(placed.points(), cloth.yarns().points(), "{name} has not moved");
        let settings = Settings::of(cloth.yarns());
        let mesh = Pipeline::new(cloth.yarns()).settings(settings).mesh(&*device).unwrap();
        texere::write(&mesh, &own).unwrap();

        let output =
            texere(&["mesh", path.to_str().unwrap(), "--device", "cpu", "-o", other.to_str().unwrap()]);
        assert!(output.status.success(), "{name}: {}", stderr(&output));
        assert!(std::fs::read(&own).unwrap() == std::fs::read(&other).unwrap(), "{name}: other bytes");
    }
}
