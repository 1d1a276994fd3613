//! Measures how soon calls of the C library end after they are asked to end. The program makes each
//! call many times, and asks the call to end at a random moment of the time that the call takes.
//!
//! `cargo run --release -p texere-bench --features capi,gpu --bin c-cancel -- [ROUNDS [CALL]]`
//!
//! Each line of the output is about one call. The line begins with the time that the call takes if
//! nothing asks it to end. The median and the longest of the times from `texere_run_cancel` to the
//! call's return follow. Then comes how long the call had run before it was asked to end, in the
//! round with the longest time. Last comes the number of rounds that were measured.

mod calls;

use std::error::Error;
use std::ffi::c_void;
use std::ptr::{null, null_mut};
use std::time::{Duration, Instant};

use calls::{design, done, made, plain_weave, sized};
use texere_bench::median;
use texere_c::texere_status::{TEXERE_CANCELLED, TEXERE_OK};
use texere_c::*;

/// The longest time that a call runs before it is asked to end. It keeps the rounds short.
const MOST: Duration = Duration::from_secs(5);

/// The name of a call that takes long, and the call.
type Call = (&'static str, Box<dyn Fn(*const texere_run) -> texere_status>);

/// Random numbers by SplitMix (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// A random number from 0 to 1.
    fn share(&mut self) -> f64 {
        self.next() as f64 / u64::MAX as f64
    }
}

/// The text of a knit of `size` by `size` stitches, each knit or purl at random. The knit is
/// repeated `copies` times each way.
fn knit(size: usize, copies: usize) -> String {
    let mut random = Random(1);
    let row =
        |_| (0..size).map(|_| if random.next().is_multiple_of(2) { 'k' } else { 'p' }).collect::<String>();
    let rows: Vec<_> = (0..size).map(row).collect();
    format!(
        "[knit]\nchart = \"\"\"\n{}\n\"\"\"\nrepeat = [{copies}, {copies}]\nwales_per_cm = 7.5\n\
         courses_per_cm = 10.0\n[yarns.cream]\ntex = 30.0\n",
        rows.join("\n")
    )
}

unsafe extern "C" fn take_piece(_: *mut c_void, _: *const texere_piece) -> i32 {
    0
}

unsafe extern "C" fn take_bytes(_: *mut c_void, _: u64, _: *const u8, _: usize) -> i32 {
    0
}

fn rest(name: &'static str, text: &str, device: *mut texere_device) -> Result<Call, Box<dyn Error>> {
    let design = design(text)?;
    let rest = move |run| {
        let mut cloth = null_mut();
        // SAFETY: the handles live as long as the program, and the variable `cloth` as long as the
        // call.
        unsafe {
            let status = texere_cloth_rest(design, device, run, &mut cloth);
            texere_cloth_free(cloth);
            status
        }
    };
    Ok((name, Box::new(rest)))
}

fn calls() -> Result<Vec<Call>, Box<dyn Error>> {
    let text = plain_weave(815, 750);
    let settled = text.replace("settle = false", "settle = true");
    let cpu = "cpu";
    let file = std::env::temp_dir().join(format!("c-cancel-{}.ply", std::process::id()));
    let path: &'static str = file.to_str().ok_or("a path that is not UTF-8")?.to_owned().leak();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let device = made(|out| texere_device_open(cpu.as_ptr().cast(), cpu.len(), out))?;
        let weave = design(&text)?;
        let cloth = made(|out| texere_cloth_placed(weave, out))?;
        let yarns = made(|out| texere_cloth_yarns(cloth, out))?;
        let plan = made(|out| texere_plan_new(yarns, device, null(), out))?;
        let mut counts: texere_counts = sized();
        done(texere_plan_counts(plan, &mut counts))?;
        let vertices = vec![[1_f32; 6]; counts.vertices as usize].leak().as_mut_ptr().cast();
        let indices = vec![1_u32; counts.indices as usize].leak().as_mut_ptr();
        let mut calls: Vec<Call> = vec![
            rest("rest, chart of 60 x 60", &knit(60, 1), device)?,
            rest("rest, 100 x 100 copies", &knit(4, 100), device)?,
            rest("rest, weave of 815 x 750", &settled, device)?,
            rest("placed, weave of 815 x 750", &text, device)?,
            (
                "mesh",
                Box::new(move |run| {
                    texere_plan_mesh(plan, run, vertices, counts.vertices, indices, counts.indices)
                }),
            ),
            ("stream", Box::new(move |run| texere_plan_stream(plan, run, Some(take_piece), null_mut()))),
            (
                "file to a callback",
                Box::new(move |run| {
                    texere_plan_write_to(plan, run, TEXERE_FORMAT_PLY, Some(take_bytes), null_mut())
                }),
            ),
            ("write", Box::new(move |run| texere_plan_write(plan, run, path.as_ptr().cast(), path.len()))),
            (
                "check",
                Box::new(move |run| {
                    let mut check = null_mut();
                    let status = texere_check_new(cloth, null(), TEXERE_ACCURACY, run, &mut check);
                    texere_check_free(check);
                    status
                }),
            ),
        ];
        calls.extend(pictures(yarns)?);
        Ok(calls)
    }
}

/// Calls of renderers. There are none without the feature `gpu`.
fn pictures(yarns: *mut texere_yarns) -> Result<Vec<Call>, Box<dyn Error>> {
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let Ok(renderer) = made(|out| texere_renderer_open(null(), 0, out)) else { return Ok(Vec::new()) };
        let small = made(|out| texere_renderer_open(null(), 0, out))?;
        let swatch = design(&plain_weave(60, 60))?;
        let swatch = made(|out| texere_cloth_placed(swatch, out))?;
        let swatch = made(|out| texere_cloth_yarns(swatch, out))?;
        done(texere_renderer_show(small, swatch, null(), null()))?;
        let mut usual: texere_picture = sized();
        done(texere_picture_default(&mut usual))?;
        let picture: &texere_picture = Box::leak(Box::new(usual));
        let [width, height] = [usual.width, usual.height].map(|side| side as usize);
        let pixels = vec![0_u8; 4 * width * height].leak();
        let (data, size) = (pixels.as_mut_ptr().cast(), pixels.len() as u64);
        let view: &texere_view = Box::leak(Box::new(texere_view { data, size, stride: 4 * width as u64 }));
        Ok(vec![
            (
                "show, weave of 815 x 750",
                Box::new(move |run| texere_renderer_show(renderer, yarns, null(), run)),
            ),
            ("picture", Box::new(move |run| texere_renderer_picture(small, picture, run, view))),
        ])
    }
}

/// Makes a call, and asks it to end after `delay`. Returns the time from the request to the call's
/// return, or None if the call had returned before the request.
fn asked(call: &Call, delay: Duration) -> Result<Option<Duration>, Box<dyn Error>> {
    // SAFETY: the variable for the handle lives as long as the call.
    let run = made(|out| unsafe { texere_run_new(out) })?;
    let address = run.expose_provenance();
    let (ended, status, asked) = std::thread::scope(|scope| {
        let canceller = scope.spawn(move || {
            std::thread::sleep(delay);
            let asked = Instant::now();
            // SAFETY: the library looks the handle up.
            unsafe { texere_run_cancel(std::ptr::with_exposed_provenance(address)) };
            asked
        });
        let status = call.1(run);
        (Instant::now(), status, canceller.join())
    });
    let asked = asked.map_err(|_| "a thread ended early")?;
    // SAFETY: the library looks the handle up.
    unsafe { texere_run_free(run) };
    if status != TEXERE_OK && status != TEXERE_CANCELLED {
        done(status)?;
    }
    // A call may also end with TEXERE_OK. Then the request came too late, or the call did not
    // notice it.
    Ok((ended > asked).then(|| ended - asked))
}

fn main() -> Result<(), Box<dyn Error>> {
    let rounds = std::env::args().nth(1).map_or(Ok(40), |rounds| rounds.parse())?;
    let only = std::env::args().nth(2).unwrap_or_default();
    let mut random = Random(2);
    for call in calls()?.into_iter().filter(|(name, _)| name.contains(&only)) {
        let start = Instant::now();
        done(call.1(null()))?;
        let whole = start.elapsed();
        let mut times = Vec::new();
        let mut longest = (Duration::ZERO, Duration::ZERO);
        for _ in 0..rounds {
            let delay = whole.min(MOST).mul_f64(random.share());
            if let Some(time) = asked(&call, delay)? {
                times.push(1e3 * time.as_secs_f64());
                longest = longest.max((time, delay));
            }
        }
        println!(
            "{:28} {:8.0} ms: median {:6.1} ms, longest {:6.1} ms, asked after {:.0} ms ({} asked)",
            call.0,
            1e3 * whole.as_secs_f64(),
            median(times.clone()),
            1e3 * longest.0.as_secs_f64(),
            1e3 * longest.1.as_secs_f64(),
            times.len()
        );
    }
    Ok(())
}
