//! Measures and checks from C are equal to those from Rust and those of the command line.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

#[path = "common/calls.rs"]
mod calls;
mod common;

use std::ffi::CStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::{null, null_mut};

use calls::{done, made, opened};
use common::{message, sized};
use serde_json::Value;
use texere_c::texere_status::*;
use texere_c::*;

fn designs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs")
}

/// The cloth of a design from C and from Rust, at rest if the design asks for it.
fn cloth_of(path: &Path) -> (*mut texere_cloth, texere::Cloth) {
    let ((device, backend), path) = (opened("cpu"), path.to_str().unwrap());
    // SAFETY: all pointers are those of values that live as long as the calls.
    let cloth = unsafe {
        let design = made(|out| texere_design_read(path.as_ptr().cast(), path.len(), out));
        made(|out| texere_cloth_rest(design, device, null(), out))
    };
    (cloth, texere::read(path).unwrap().rest(&*backend).run().unwrap())
}

fn check(cloth: *const texere_cloth, accuracy: f64) -> *mut texere_check {
    // SAFETY: all pointers are those of values that live as long as the call.
    made(|out| unsafe { texere_check_new(cloth, null(), accuracy, null(), out) })
}

/// A copy of a text that the library lends.
fn lent(call: impl FnOnce(*mut *const std::ffi::c_char) -> texere_status) -> String {
    let mut words = null();
    done(call(&mut words));
    // SAFETY: the library ends it with a zero byte.
    unsafe { CStr::from_ptr(words) }.to_str().unwrap().to_owned()
}

fn diagnosis(check: *const texere_check) -> (texere_diagnosis, String) {
    let mut found: texere_diagnosis = sized();
    // SAFETY: all pointers are those of values that live as long as the call.
    done(unsafe { texere_check_diagnosis(check, &mut found) });
    (
        found,
        lent(|words| {
            // SAFETY: as above.
            unsafe { words.write(found.words) };
            TEXERE_OK
        }),
    )
}

/// All faults, with their words.
fn faults(check: *const texere_check) -> Vec<(texere_fault, String)> {
    let fault = |number| {
        let mut fault: texere_fault = sized();
        // SAFETY: all pointers are those of values that live as long as the call; the library ends
        // words with a zero byte.
        unsafe {
            done(texere_check_fault(check, number, &mut fault));
            (fault, CStr::from_ptr(fault.words).to_str().unwrap().to_owned())
        }
    };
    (0..diagnosis(check).0.faults).map(fault).collect()
}

/// Runs a command of `texere`. Returns its exit code, its standard output and its standard error.
fn texere(arguments: &[&str], design: &Path) -> (i32, String, String) {
    // The program `texere` lies in the folder above the tests. `cargo test --workspace` builds it.
    let program = std::env::current_exe().unwrap().parent().unwrap().join("../texere");
    let output = Command::new(&program).args(arguments).arg(design).output();
    assert!(output.is_ok(), "{}: {output:?}: build texere-cli", program.display());
    let output = output.unwrap();
    let [said, words] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    (output.status.code().unwrap(), said, words)
}

/// A twill that is too dense: its ends lie 1.3 diameters apart, which leaves no room for picks.
fn dense(folder: &Path) -> PathBuf {
    let path = folder.join("dense.toml");
    let text = "weave = { notation = \"3/1\", ends = 20, picks = 16 }\nfinish.settle = false\n\
        yarns.a = { diameter_mm = 0.3, tex = 20 }\nwarp = { yarns = [\"a\"], spacing_mm = 0.4 }\n\
        weft = { yarns = [\"a\"], spacing_mm = 0.66 }\n";
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn the_json_is_that_of_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let all = ["poplin.toml", "jersey.toml"].map(|name| designs().join(name));
    for path in all.into_iter().chain([dense(folder.path())]) {
        let check = check(cloth_of(&path).0, TEXERE_ACCURACY);
        // SAFETY: all pointers are those of values that live as long as the calls.
        let (measures, faults) = unsafe {
            (lent(|to| texere_check_measures_json(check, to)), lent(|to| texere_check_json(check, to)))
        };
        assert_eq!(measures + "\n", texere(&["inspect", "--json"], &path).1, "{}", path.display());
        let (code, wanted, words) = texere(&["check", "--json"], &path);
        assert_eq!(faults.clone() + "\n", wanted, "{}", path.display());
        // The verdict is the one that the command line prints.
        let (found, verdict) = diagnosis(check);
        let parsed: Value = serde_json::from_str(&faults).unwrap();
        assert_eq!(parsed["clean"], (found.clean == 1), "{}", path.display());
        assert_eq!(found.clean == 1, code == 0, "{}", path.display());
        if code == 0 {
            assert_eq!(verdict, "clean");
        } else {
            assert_eq!(words.lines().last().unwrap(), format!("texere: {} {verdict}", path.display()));
        }
        // SAFETY: the library looks handles up.
        unsafe { texere_check_free(check) };
    }
}

/// The number at a path of keys, or NaN where there is none.
fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

/// Makes sure that `found` is the number at a path of keys. The two may differ in the last digit,
/// because the reader of JSON is not exact to that digit.
#[track_caller]
fn is_at(found: f64, value: &Value, path: &str) {
    let wanted = number(value, path);
    let same = (found - wanted).abs() <= 1e-14 * wanted.abs() || found.is_nan() && wanted.is_nan();
    assert!(same, "{path}: {found}, but the JSON says {wanted}");
}

/// The structs have the same numbers as the JSON.
#[test]
fn measures_are_those_of_the_json() {
    let folder = tempfile::tempdir().unwrap();
    let all = ["poplin.toml", "jersey.toml"].map(|name| designs().join(name));
    for path in all.into_iter().chain([dense(folder.path())]) {
        let (cloth, own) = cloth_of(&path);
        let mut found: texere_measures = sized();
        // SAFETY: all pointers are those of values that live as long as the calls.
        let json = unsafe {
            done(texere_cloth_measures(cloth, &mut found));
            lent(|to| texere_check_measures_json(check(cloth, TEXERE_ACCURACY), to))
        };
        let json: Value = serde_json::from_str(&json).unwrap();
        let pairs = [
            (found.width, "/size_mm/0"),
            (found.height, "/size_mm/1"),
            (found.thickness, "/measures/thickness_mm"),
            (found.length, "/measures/length_mm"),
            (found.areal_weight, "/measures/areal_weight_g_per_m2"),
            (found.warp_crimp, "/measures/crimp/warp"),
            (found.weft_crimp, "/measures/crimp/weft"),
            (found.warp_cover, "/measures/cover/fraction/warp"),
            (found.weft_cover, "/measures/cover/fraction/weft"),
            (found.cover, "/measures/cover/cloth"),
            (found.warp_cover_factor, "/measures/cover/factor/warp"),
            (found.weft_cover_factor, "/measures/cover/factor/weft"),
            (found.cover_factor, "/measures/cover/cloth_factor"),
            (found.loop_length, "/measures/knit/loop_length_mm"),
            (found.loops_per_cm2, "/measures/knit/loops_per_cm2"),
            (found.tightness, "/measures/knit/tightness"),
        ];
        for (value, at) in pairs {
            is_at(value, &json, at);
        }
        let counts = [found.loops, found.courses.into(), found.wales.into()];
        assert_eq!(counts, ["loops", "courses", "wales"].map(|key| json[key].as_u64().unwrap_or(0)));
        let mut lengths = vec![0.0; found.materials as usize];
        // SAFETY: as above.
        done(unsafe { texere_cloth_lengths(cloth, lengths.as_mut_ptr(), found.materials.into()) });
        assert_eq!(lengths, own.design().structure.measures(own.yarns()).unwrap().length_mm);
    }
}

/// Each fault in the command line's JSON is among the faults of `texere_check_fault`, with its
/// place and its words.
#[test]
fn faults_are_those_of_the_json() {
    let folder = tempfile::tempdir().unwrap();
    let path = dense(folder.path());
    let check = check(cloth_of(&path).0, TEXERE_ACCURACY);
    let (found, verdict) = diagnosis(check);
    // SAFETY: all pointers are those of values that live as long as the calls.
    let json: Value = serde_json::from_str(&unsafe { lent(|to| texere_check_json(check, to)) }).unwrap();
    assert_eq!(found.clean, 0);
    is_at(found.touching, &json, "/touching");
    is_at(found.width, &json, "/drawn/width");
    let all = faults(check);
    let of = |kind: u32| all.iter().filter(move |(fault, _)| fault.kind == kind);
    let pierces = json["pierces"]["worst"].as_array().unwrap();
    assert_eq!(of(TEXERE_FAULT_PIERCES).count(), pierces.len());
    is_at(found.clearance, &pierces[0], "/ratio");
    for ((fault, words), wanted) in of(TEXERE_FAULT_PIERCES).zip(pierces) {
        is_at(fault.value, wanted, "/ratio");
        for (axis, at) in fault.position.iter().enumerate() {
            is_at(*at, wanted, &format!("/place_mm/{axis}"));
        }
        for yarn in wanted["yarns"].as_array().unwrap() {
            assert!(words.contains(yarn.as_str().unwrap()), "{words}");
        }
    }
    let jams = json["jams"]["threads"].as_array().unwrap();
    assert_eq!(of(TEXERE_FAULT_JAMS).count(), jams.len());
    for ((fault, words), wanted) in of(TEXERE_FAULT_JAMS).zip(jams) {
        is_at(fault.value * number(wanted, "/pitch_min_mm"), wanted, "/pitch_mm");
        assert!(fault.position.iter().all(|axis| axis.is_nan()));
        assert!(words.starts_with(&format!("{}: ", wanted["thread"].as_str().unwrap())), "{words}");
    }
    let (fold, words) = of(TEXERE_FAULT_FOLDS).next().unwrap();
    is_at(fold.value, &json, "/folds/min");
    is_at(found.bend, &json, "/folds/min");
    assert!(words.starts_with(json["folds"]["yarn"].as_str().unwrap()), "{words}");
    let (turned, _) = of(TEXERE_FAULT_INSIDE_OUT).next().unwrap();
    is_at(turned.value, &json, "/inside_out/inwards");
    assert_eq!(turned.value, found.inwards as f64);
    assert!(verdict.contains("pierces itself") && verdict.contains("jams"), "{verdict}");
    assert!(!json["cures"].as_array().unwrap().is_empty());
}

#[test]
fn warnings_are_those_of_the_json_and_a_cancelled_run_ends_a_check() {
    let folder = tempfile::tempdir().unwrap();
    let path = dense(folder.path());
    let cloth = cloth_of(&path).0;
    let check = check(cloth, TEXERE_ACCURACY);
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let json: Value = serde_json::from_str(&lent(|to| texere_check_measures_json(check, to))).unwrap();
        let said: Vec<_> = (0..diagnosis(check).0.warnings)
            .map(|number| lent(|to| texere_check_warning(check, number, to)))
            .collect();
        assert!(!said.is_empty());
        assert_eq!(json["warnings"], Value::from(said));
        let run = made(|out| texere_run_new(out));
        let whole = made(|out| texere_check_new(cloth, null(), TEXERE_ACCURACY, run, out));
        let mut share = 0.0;
        done(texere_run_progress(run, &mut share));
        assert!(share > 0.5 && !whole.is_null(), "{share}");
        done(texere_run_cancel(run));
        let mut ended = null_mut();
        let status = texere_check_new(cloth, null(), TEXERE_ACCURACY, run, &mut ended);
        assert_eq!((status, ended), (TEXERE_CANCELLED, null_mut()), "{}", message());
    }
}
