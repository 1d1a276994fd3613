//! `texere view`: a window on a virtual screen, a pointer and keys.

#![cfg(all(target_os = "linux", feature = "view"))]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod screen;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use screen::{DEADLINE, Picture, Screen, wait_for};

/// The window's size, and the x at which its panel ends and the cloth may begin, pixels.
const SIZE: [u32; 2] = [620, 420];
const PANEL: u32 = 250;

/// Colours of the ends and the picks of a cloth, from the first one.
const ENDS: [(&str, [u8; 3]); 4] =
    [("red", [220, 20, 20]), ("yellow", [210, 200, 20]), ("green", [20, 160, 30]), ("teal", [10, 170, 180])];
const PICKS: [(&str, [u8; 3]); 4] =
    [("blue", [30, 40, 220]), ("violet", [150, 20, 220]), ("black", [8, 8, 8]), ("orange", [240, 120, 10])];

/// Two pictures of the same cloth differ by less than `ALIKE` levels of 255, pictures of different
/// cloths by more than `UNLIKE`.
const ALIKE: f32 = 2.5;
const UNLIKE: f32 = 8.0;

/// X11's number of the left control key.
const CONTROL: u32 = 0xffe3;

fn design(notation: &str, picks: usize) -> String {
    let hex = |[red, green, blue]: [u8; 3]| format!("#{red:02x}{green:02x}{blue:02x}");
    let yarns: String = ENDS
        .iter()
        .chain(&PICKS)
        .map(|(name, color)| format!("[yarns.{name}]\ndiameter_mm = 0.7\ncolor = \"{}\"\n", hex(*color)))
        .collect();
    let names = |set: &[(&str, [u8; 3])]| {
        set.iter().map(|(name, _)| format!("{name:?}")).collect::<Vec<_>>().join(", ")
    };
    format!(
        "[weave]\nnotation = \"{notation}\"\nends = 4\npicks = {picks}\n{yarns}\
         [warp]\nyarns = [{}]\nspacing_mm = 1.0\n[weft]\nyarns = [{}]\nspacing_mm = 1.0\n",
        names(&ENDS),
        names(&PICKS)
    )
}

/// The program with its window, and its output.
struct Viewer {
    program: Child,
    lines: Receiver<String>,
}

impl Viewer {
    fn open(design: &Path, screen: &Screen, settle: &str) -> Self {
        let mut program = Command::new(env!("CARGO_BIN_EXE_texere"))
            .args([
                "view",
                settle,
                "--device",
                "wgpu:llvmpipe",
                "--size",
                &format!("{}x{}", SIZE[0], SIZE[1]),
            ])
            .arg(design)
            .env("DISPLAY", &screen.name)
            .env_remove("WAYLAND_DISPLAY")
            // Without this variable drivers print warnings, which the program must not show.
            .env_remove("XDG_RUNTIME_DIR")
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (said, lines) = channel();
        let out = BufReader::new(program.stdout.take().unwrap());
        thread::spawn(move || out.lines().map_while(Result::ok).try_for_each(|line| said.send(line)));
        Self { program, lines }
    }

    /// The next line of output. Asserts that it begins with `start`.
    fn says(&self, start: &str) -> String {
        let line =
            self.lines.recv_timeout(DEADLINE).unwrap_or_else(|_| panic!("nothing is said; expected {start}"));
        assert!(line.starts_with(start), "{line} is said and not {start}");
        line
    }

    /// Waits for the program's end. Asserts that it succeeds and prints no error.
    fn ends(&mut self) {
        let status = wait_for("the program's end", || self.program.try_wait().unwrap());
        let mut errors = String::new();
        std::io::Read::read_to_string(&mut self.program.stderr.take().unwrap(), &mut errors).unwrap();
        assert!(status.success() && errors.is_empty(), "{status}: {errors}");
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// The rectangle of the cloth in a picture of its face: its least and greatest x and y. None if
/// nothing is coloured.
fn cloth(picture: &Picture) -> Option<[[u32; 2]; 2]> {
    let is_yarn = |at: &[u32; 2]| {
        let color = picture.at(*at);
        color.iter().max().unwrap() - color.iter().min().unwrap() > 40
    };
    let (mut low, mut high) = ([u32::MAX; 2], [0; 2]);
    for at in picture.places(PANEL).filter(is_yarn) {
        low = [0, 1].map(|axis| low[axis].min(at[axis]));
        high = [0, 1].map(|axis| high[axis].max(at[axis]));
    }
    (low[0] < high[0]).then_some([low, high])
}

/// The middle of a crossing in a cloth of four ends and four picks, which are counted from 1.
fn crossing(picture: &Picture, end: u32, pick: u32) -> [u32; 2] {
    let [low, high] = cloth(picture).unwrap();
    let half = |axis: usize, number: u32| (high[axis] - low[axis]) * (2 * number - 1) / 8;
    [low[0] + half(0, end), high[1] - half(1, pick)]
}

/// The colour of `set` with the nearest hue.
fn like(color: [u8; 3], set: &[(&'static str, [u8; 3])]) -> &'static str {
    let unit = |color: [u8; 3]| {
        let color = color.map(|channel| f32::from(channel) / 255.0);
        let length = color.iter().map(|channel| channel * channel).sum::<f32>().sqrt().max(1e-3);
        color.map(|channel| channel / length)
    };
    let off = |one: [u8; 3]| -> f32 {
        unit(one).iter().zip(unit(color)).map(|(one, other)| (one - other).powi(2)).sum()
    };
    set.iter().min_by(|one, other| off(one.1).total_cmp(&off(other.1))).unwrap().0
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("texere-view-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn a_window_shows_turns_names_edits_and_reloads_a_cloth() {
    let folder = folder("edits");
    let file = folder.join("cloth.toml");
    fs::write(&file, design("plain", 4)).unwrap();
    let screen = Screen::open();
    let mut viewer = Viewer::open(&file, &screen, "--no-settle");
    assert!(viewer.says("shown: ").contains("8 yarns"));
    let window = screen.window();
    let rest = [PANEL + 10, 10];
    screen.point_at(rest);
    let face = screen.picture("a cloth", |picture| cloth(picture).is_some());
    let is_face = |picture: &Picture| picture.off(&face, PANEL) < ALIKE;
    let is_another = |picture: &Picture| picture.off(&face, PANEL) > UNLIKE;

    // A drag turns the cloth, and a key brings the face back.
    let middle = crossing(&face, 2, 2);
    screen.point_at(middle);
    screen.button(true);
    // The drag goes on until the cloth follows: all movements while one picture is drawn count as
    // one.
    let mut step = 0;
    wait_for("another side", || {
        step += 1;
        screen.point_at([middle[0] + step % 160, middle[1] - step % 120]);
        (step % 8 == 0 && screen.picture("any", |_| true).off(&face, PANEL) > UNLIKE).then_some(())
    });
    screen.button(false);
    screen.point_at(rest);
    screen.press(&[u32::from(b'f')]);
    screen.picture("the face", is_face);

    // At each crossing the visible yarn is the one that is named.
    let mut seen = Vec::new();
    for (end, pick) in [(1, 1), (1, 2), (3, 2), (4, 4)] {
        let at = crossing(&face, end, pick);
        screen.point_at(at);
        screen.button(true);
        screen.button(false);
        let said = viewer.says("picked: ");
        let colors = [ENDS[end as usize - 1], PICKS[pick as usize - 1]];
        let color = like(face.at(at), &colors);
        let name = if color == colors[0].0 {
            format!("end {end} at pick {pick}, {color}")
        } else {
            format!("pick {pick} at end {end}, {color}")
        };
        assert_eq!(said, format!("picked: {name}"));
        seen.push(color == colors[0].0);
    }
    // Plain weave: neighbours differ.
    assert_eq!(seen, [seen[0], !seen[0], !seen[0], seen[0]]);

    // A click on a crossing changes its lift, and Ctrl+Z changes it back.
    screen.press(&[u32::from(b'l')]);
    let at = crossing(&face, 3, 2);
    screen.point_at(at);
    screen.button(true);
    screen.button(false);
    viewer.says("picked: ");
    let was_up = like(face.at(at), &[ENDS[2], PICKS[1]]) == ENDS[2].0;
    let now = if was_up { "below" } else { "above" };
    assert_eq!(viewer.says("lifted: "), format!("lifted: end 3 is {now} pick 2"));
    viewer.says("shown: ");
    screen.point_at(rest);
    let is_up = |picture: &Picture| like(picture.at(at), &[ENDS[2], PICKS[1]]) == ENDS[2].0;
    screen.picture("the other yarn", |picture| is_up(picture) != was_up);
    screen.press(&[CONTROL, u32::from(b's')]);
    let copy = folder.join("cloth-edited.toml");
    assert_eq!(viewer.says("saved: ").split(';').next(), Some(format!("saved: {}", copy.display()).as_str()));
    let draft =
        Command::new(env!("CARGO_BIN_EXE_texere")).arg("draft").arg(&copy).arg("--text").output().unwrap();
    // The last of four picks comes first.
    let lift = String::from_utf8_lossy(&draft.stdout).lines().nth(2).and_then(|row| row.chars().nth(2));
    assert_eq!(lift, Some(if was_up { '0' } else { '1' }), "{draft:?}");
    screen.press(&[CONTROL, u32::from(b'z')]);
    viewer.says("lifted: ");
    viewer.says("shown: ");
    screen.picture("the lift as it was", is_face);

    // A broken file is reported with its line, and the cloth stays.
    fs::write(&file, design("plain", 4).replace("[weft]", "[weft")).unwrap();
    let said = viewer.says("failed: ");
    assert!(said.contains("cloth.toml") && said.contains("line"), "{said}");
    screen.picture("the cloth as it was", is_face);
    fs::write(&file, design("2/2", 8)).unwrap();
    assert!(viewer.says("shown: ").contains("12 yarns"));
    let longer = screen.picture("a longer cloth", is_another);

    // A larger window has a larger picture.
    let larger = [SIZE[0] + 140, SIZE[1] + 120];
    let corner = [larger[0] - 5, larger[1] - 5];
    assert_eq!(longer.at(corner), [0; 3], "the screen's own black");
    screen.resize(window, larger);
    screen.picture("ground in the corner", |picture| picture.at(corner).iter().all(|&channel| channel > 100));

    screen.close(window);
    viewer.ends();
    fs::remove_dir_all(&folder).unwrap();
}

/// Cloth that settles is shown at once, and again at rest. A click names the threads of the cloth
/// at rest.
#[test]
fn cloth_is_shown_before_it_settles_and_after() {
    let folder = folder("settles");
    let file = folder.join("cloth.toml");
    fs::write(&file, design("plain", 4)).unwrap();
    let screen = Screen::open();
    let viewer = Viewer::open(&file, &screen, "--settle");
    assert!(viewer.says("shown: ").contains("8 yarns as its structure puts them"));
    assert!(viewer.says("shown: ").contains("8 yarns settled"));
    screen.window();
    let settled = screen.picture("a cloth", |picture| cloth(picture).is_some());
    let at = crossing(&settled, 1, 4);
    screen.point_at(at);
    screen.button(true);
    screen.button(false);
    let up = like(settled.at(at), &[ENDS[0], PICKS[3]]) == ENDS[0].0;
    let named = if up { "picked: end 1 at pick 4, red" } else { "picked: pick 4 at end 1, orange" };
    assert_eq!(viewer.says("picked: "), named);
    fs::remove_dir_all(&folder).unwrap();
}

/// The window is resized again and again while the program makes one cloth after the other.
#[test]
fn a_window_is_resized_while_its_cloth_is_read_again() {
    let folder = folder("resized");
    let file = folder.join("cloth.toml");
    fs::write(&file, design("plain", 4)).unwrap();
    let screen = Screen::open();
    let mut viewer = Viewer::open(&file, &screen, "--no-settle");
    viewer.says("shown: ");
    let window = screen.window();
    for turn in 0..400 {
        screen.resize(window, [300 + turn * 53 % 97, 200 + turn * 31 % 89]);
        if turn % 4 == 0 {
            fs::write(&file, design("plain", 4 + turn as usize / 4 % 2)).unwrap();
        }
        thread::sleep(Duration::from_millis(40));
        assert_eq!(viewer.program.try_wait().unwrap(), None, "after {turn} sizes");
    }
    // The window still works: a last cloth is shown, in a window of a last size.
    fs::write(&file, design("plain", 9)).unwrap();
    let is_last = |line: String| line.contains("13 yarns").then_some(());
    wait_for("the last cloth", || is_last(viewer.lines.recv_timeout(DEADLINE).unwrap()));
    screen.resize(window, SIZE);
    screen.picture("ground in the corner", |picture| {
        picture.at([SIZE[0] - 5, SIZE[1] - 5]).iter().all(|&channel| channel > 100)
    });
    screen.close(window);
    viewer.ends();
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_file_that_changes_without_end_is_read_all_the_same() {
    let folder = folder("restless");
    let file = folder.join("cloth.toml");
    fs::write(&file, design("plain", 4)).unwrap();
    let screen = Screen::open();
    let mut viewer = Viewer::open(&file, &screen, "--no-settle");
    assert!(viewer.says("shown: ").contains("8 yarns"));
    let other = folder.join("other.toml");
    let is_read = AtomicBool::new(false);
    thread::scope(|scope| {
        scope.spawn(|| {
            let start = Instant::now();
            while !is_read.load(Ordering::Relaxed) && start.elapsed() < 2 * DEADLINE {
                // The file is replaced by a whole one each time.
                fs::write(&other, design("plain", 7)).unwrap();
                fs::rename(&other, &file).unwrap();
                thread::sleep(Duration::from_millis(20));
            }
        });
        let said = viewer.lines.recv_timeout(DEADLINE);
        is_read.store(true, Ordering::Relaxed);
        assert!(said.as_ref().is_ok_and(|said| said.contains("11 yarns")), "{said:?}");
    });
    screen.close(screen.window());
    viewer.ends();
    fs::remove_dir_all(&folder).unwrap();
}

/// Closing does not wait for yarns that settle, nor for a picture or a cloth that the device makes.
#[test]
fn a_window_that_is_closed_is_gone_at_once_whatever_runs() {
    /// A busy machine takes longer than a second. The work that is interrupted would take many
    /// times as long.
    const CLOSING: Duration = Duration::from_secs(5);
    let folder = folder("closed");
    let file = folder.join("cloth.toml");
    let large = design("twill 2/2", 120).replace("ends = 4", "ends = 120");
    let screen = Screen::open();
    let cases = [
        ("at once", false, false, 0),
        ("soon", false, false, 300),
        ("while the first picture is made", true, false, 0),
        ("while yarns settle", true, false, 700),
        ("while it is read again", true, true, 300),
    ];
    for (when, is_shown, is_changed, delay) in cases {
        fs::write(&file, &large).unwrap();
        let mut viewer = Viewer::open(&file, &screen, "--settle");
        let window = screen.window();
        if is_shown {
            viewer.says("shown: ");
        }
        if is_changed {
            fs::write(&file, format!("{large}\n")).unwrap();
        }
        thread::sleep(Duration::from_millis(delay));
        let start = Instant::now();
        screen.close(window);
        viewer.ends();
        let took = start.elapsed();
        assert!(took < CLOSING, "closed {when}: {took:?}");
    }
    fs::remove_dir_all(&folder).unwrap();
}

/// Faults of the command line or the design are reported before a window opens.
#[test]
fn what_can_t_be_shown_ends_the_program() {
    let folder = folder("refused");
    let [good, broken] = ["good.toml", "broken.toml"].map(|name| folder.join(name));
    fs::write(&good, design("plain", 4)).unwrap();
    fs::write(&broken, "weave = 3").unwrap();
    let run = |design: &Path, device: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_texere"))
            .args(["view", "--device", device])
            .arg(design)
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let cases = [
        (run(&broken, "auto"), 3, "broken.toml"),
        (run(&folder.join("none.toml"), "auto"), 1, "none.toml"),
        (run(&good, "abacus"), 2, "abacus"),
        (run(&good, "wgpu:llvmpipe"), 1, "DISPLAY"),
    ];
    for ((code, errors), expected, named) in cases {
        assert_eq!(code, Some(expected), "{errors}");
        assert!(errors.contains(named) && !errors.contains("panicked"), "{errors}");
    }
    fs::remove_dir_all(&folder).unwrap();
}
