//! `texere bake`: the folder that it makes, and what it refuses.

use std::fs;

use crate::{design, stderr, stdout, texere};

#[test]
fn a_folder_is_made_once() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("denim");
    let (denim, output) = (design("denim.toml"), folder.to_str().unwrap().to_owned());
    let made = texere(&["bake", &denim, "-o", &output, "--texel", "0.05"]);
    assert!(made.status.success(), "{}", stderr(&made));
    assert!(stdout(&made).contains("1.411 × 1.814 mm, which tile"), "{}", stdout(&made));
    let document = fs::read_to_string(folder.join("Denim__3_1_right_hand_twill.u3m")).unwrap();
    assert!(document.contains("\"type\": \"Woven\""));
    // 16 maps as PNG and as EXR.
    assert_eq!(fs::read_dir(folder.join("textures")).unwrap().count(), 32);

    let again = texere(&["bake", &denim, "-o", &output, "--texel", "0.05"]);
    assert_eq!(again.status.code(), Some(1));
    assert!(stderr(&again).contains("the folder has files in it"), "{}", stderr(&again));
    // A folder that can't be made is refused before the design is read.
    let nowhere = format!("{output}/missing/maps");
    let refused = texere(&["bake", "no-design.toml", "-o", &nowhere]);
    assert!(stderr(&refused).contains("missing/maps"), "{}", stderr(&refused));
    assert_eq!(document, fs::read_to_string(folder.join("Denim__3_1_right_hand_twill.u3m")).unwrap());
    assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 1);
}

#[test]
fn what_can_not_be_baked_leaves_no_folder() {
    let parent = tempfile::tempdir().unwrap();
    let (jersey, output) = (design("jersey.toml"), parent.path().join("jersey").to_str().unwrap().to_owned());
    for (args, said) in [
        (["--texel", "0"], "texels of 0 mm can't be baked"),
        (["--texel", "nan"], "texels of NaN mm"),
        (["--texel", "0.00001"], "take larger texels"),
        (["--area", "0,0,1"], "expected four numbers"),
        (["--area", "0,0,-1,1"], "an area of -1 by 1 mm"),
        (["--area", "500,500,1,1"], "no yarn lies in the area"),
        (["--device", "nvidia:7"], "nvidia:7"),
    ] {
        let refused = texere(&[&["bake", &jersey, "-o", &output, "--no-settle"], &args[..]].concat());
        assert!([Some(1), Some(2)].contains(&refused.status.code()), "{args:?}: {}", stderr(&refused));
        assert!(stderr(&refused).contains(said), "{args:?}: {}", stderr(&refused));
    }
    assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 0);
}
