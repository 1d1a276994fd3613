//! What a ray hits, and the name of the place in a weaver's terms.

use std::ptr::null_mut;

use texere::mesh::Ray;
use texere::yarn::YarnPlace;
use texere::{ControlPoint, Live};
use texere_c::texere_status::*;
use texere_c::*;

use crate::calls::{done, made, said};
use crate::common::message;
use crate::reading::read as design;
use crate::{TWILL, live_cloth, own_settings, settings};

/// Sixty rays down onto the cloth. Some of them hit no yarn.
fn rays() -> impl Iterator<Item = Ray> {
    let at = |number: u32| [number % 10, number / 10].map(|step| f64::from(step) * 0.63 + 0.05);
    (0..60).map(move |number| {
        let [x, y] = at(number);
        Ray { origin: [x, y, 9.0], direction: [0.0, 0.05, -2.0] }
    })
}

#[test]
fn a_hit_is_that_of_rust_and_is_called_what_a_weaver_calls_it() {
    let (live, mut rust, own) = live_cloth(TWILL, "cpu");
    let handle = design(TWILL);
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        let cloth = made(|out| texere_cloth_placed(handle, out));
        let yarns = made(|out| texere_cloth_yarns(cloth, out));
        let picker = made(|out| texere_picker_new(yarns, &settings(), out));
        done(texere_live_set_lift(live, 7, 3, 0));
        let placed = own.yarns().unwrap();
        let mut first =
            Live::given(texere::open("cpu").unwrap().into(), placed.clone(), own_settings()).unwrap();
        rust.set_lift(7, 3, false).unwrap();
        let (mut hits, mut misses, mut moved) = (0, 0, 0);
        for ray in rays() {
            let given = texere_ray { origin: ray.origin, direction: ray.direction };
            let mut found = [texere_hit { found: 7, ..texere_hit::default() }; 2];
            done(texere_picker_pick(picker, &given, &mut found[0]));
            done(texere_live_pick(live, &given, &mut found[1]));
            moved += usize::from(found[0] != found[1]);
            for (hit, wanted) in found.iter().zip([first.pick(&ray).unwrap(), rust.pick(&ray).unwrap()]) {
                let Some(wanted) = wanted else {
                    assert_eq!(*hit, texere_hit::default());
                    misses += 1;
                    continue;
                };
                hits += 1;
                let place = [hit.yarn, hit.ring, hit.side, hit.interval, hit.cap, hit.found];
                let of = wanted.place;
                assert_eq!(
                    place,
                    [of.yarn, of.ring, of.side, wanted.interval, of.cap.map_or(0, |end| 1 + end as u32), 1]
                );
                assert_eq!((hit.t, hit.distance, hit.position), (wanted.t, wanted.distance, wanted.position));
            }
            if found[0].found == 1 {
                let hit = &found[0];
                let place = YarnPlace::at(&placed, hit.yarn as usize, hit.interval as usize, hit.t).unwrap();
                let words = said(|words, size, length| texere_cloth_place(cloth, hit, words, size, length));
                assert_eq!(words, own.named(&placed, &place).to_string());
            }
            if found[1].found == 1 {
                let (hit, edited) = (&found[1], rust.yarns().unwrap());
                let place = YarnPlace::at(&edited, hit.yarn as usize, hit.interval as usize, hit.t).unwrap();
                let words = said(|words, size, length| texere_live_place(live, hit, words, size, length));
                assert_eq!(words, own.named(&edited, &place).to_string());
            }
        }
        // An end keeps every second control point. Some of its intervals then lie elsewhere in the
        // cloth. The unedited cloth must refuse to name places on these intervals, because it would
        // name other picks.
        let point = |own: &ControlPoint| texere_point {
            x: own.x,
            y: own.y,
            z: own.z,
            half_width: own.half_width(),
            half_height: own.half_height(),
        };
        let points: Vec<_> = placed.yarn_points(7).unwrap().iter().step_by(2).map(point).collect();
        done(texere_live_set_points(live, 7, points.as_ptr(), points.len()));
        let (mut refused, mut named) = (0, 0);
        for y in 1..40 {
            let above = texere_ray { origin: [3.75, 0.1 * f64::from(y), 9.0], direction: [0.0, 0.0, -1.0] };
            let mut hit = texere_hit::default();
            done(texere_live_pick(live, &above, &mut hit));
            if hit.found == 0 || hit.yarn != 7 {
                continue;
            }
            let mut length = 0;
            match texere_cloth_place(cloth, &hit, null_mut(), 0, &mut length) {
                TEXERE_OK => named += 1,
                status => {
                    assert_eq!(status, TEXERE_ARGUMENT);
                    assert!(message().contains("mm from place"), "{}", message());
                    refused += 1;
                }
            }
            done(texere_live_place(live, &hit, null_mut(), 0, &mut length));
        }
        assert!(refused > 4, "{refused} refused, {named} named");
        assert!(hits > 40 && misses > 4 && moved > 0, "{hits} hits, {misses} misses, {moved} moved");
    }
}
