//! The places where two intervals come near to one another.
//!
//! Quick tests rule out most pairs: neighbours along a yarn, intervals whose chords are too far
//! apart, surfaces with a plane between them. In all other pairs the search starts from the places
//! where the chords of both curves come near. A *valley* is a stretch along which the distance of
//! the curves hardly changes.
//!
//! ```text
//! if the yarn only leads on, or the chords are too far away: nothing
//! if a section has lobes or turns:  touch() from all approaches of the chords
//! if a plane lies between them:     nothing
//! for each approach of the chords:  keep its nearest place, refined
//! while a place lies in a valley:   keep a nearer place, if the hulls leave room for one
//! if the yarn folds in the valley:  keep the nearest places of fine chords, refined
//! ```

use std::cell::Cell;
use std::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::approach::{Side, refine};
use super::chords::{Fine, SAGITTA, SAGITTA_FINE};
use super::contact::{CLEARANCE_ACCURACY, Contact};
use super::found::Found;
use super::interval::closest;
use super::met::{Curve, Met};
use super::nearer::nearer;
use super::part::Part;
use super::rolls::Rolls;
use super::surface::Surface;
use super::touch::{touch, touch_near};
use super::tubes;
use crate::ContactError;
use crate::watch::Watch;

/// A section that reaches more than this many lengths of its interval counts by its hull alone,
/// untwisted. With half the value, and with twice, no test is red.
const DISC: f64 = 64.0;

/// The greatest difference of two places that count as one, in intervals along either curve.
const ONE_PLACE: f64 = 0.01;

/// Two intervals, the one with the lower number first.
pub(super) struct Pair<'a> {
    parts: [&'a Part<'a>; 2],
    met: [&'a Met; 2],
    curves: [&'a Curve; 2],
    sides: [Side<'a>; 2],
    /// The greatest ratio of a contact that is looked for.
    near: f64,
    /// How far both surfaces may lie from their centrelines, together, mm.
    reach: f64,
    /// Whether both intervals are of one yarn.
    same: bool,
}

impl<'a> Pair<'a> {
    pub(super) fn new(
        [(one, first), (other, second)]: [(&'a Part<'a>, &'a Met); 2],
        rolls: &Rolls,
        near: f64,
    ) -> Self {
        let (a, b) = (first.curve(one, rolls), second.curve(other, rolls));
        let side = |part: &'a Part<'a>, curve: &'a Curve| Side {
            cubic: &curve.cubic,
            support: part.line.support,
            cut: part.line.cut(part.point),
        };
        Self {
            parts: [one, other],
            met: [first, second],
            curves: [a, b],
            sides: [side(one, a), side(other, b)],
            near,
            reach: a.reach + b.reach,
            same: one.line.yarn == other.line.yarn,
        }
    }

    /// Adds the contacts of both intervals to `found`.
    ///
    /// **Errors**: [`ContactError::Cancelled`] if the caller of `watch` asks to stop.
    pub(super) fn contacts(
        &self,
        sources: Option<&[u32]>,
        found: &mut Found,
        watch: &Watch<'_>,
    ) -> Result<(), ContactError> {
        if self.leads_on() || self.is_far() {
            return Ok(());
        }
        let add = |place: DVec2, ratio: f64| {
            let [one, other] = self.parts;
            found.add(ratio, || Contact {
                places: [
                    one.line.place(one.point, place.x, sources),
                    other.line.place(other.point, place.y, sources),
                ],
                ratio,
            });
        };
        // If a yarn is so much thicker than its control points lie apart, its intervals are discs.
        // Only their hulls count.
        let discs = self.curves.into_iter().any(|curve| DISC * curve.cubic.length() < curve.reach);
        if !discs && self.surfaces().iter().any(|surface| !surface.is_simple()) {
            self.touching(add);
            // A pair like this takes as long as thousands of other pairs, so a request to stop is
            // looked for after each.
            return watch.advance(0);
        }
        let round = self.curves[0].round && self.curves[1].round;
        if round || discs || !self.is_parted() {
            self.approaches(round, discs, add);
        }
        Ok(())
    }

    /// Whether a yarn only leads on from one interval to the other, so that any approach there
    /// belongs to another pair.
    fn leads_on(&self) -> bool {
        let ([a, b], [one, other]) = (self.curves, self.parts);
        if a.even && b.even {
            a.passing.leaves_to_neighbours(&b.passing, self.sides[0].cut, self.reach)
                || b.passing.leaves_to_neighbours(&a.passing, self.sides[1].cut, self.reach)
        } else {
            self.same && one.line.leads_on(one.point, other.point)
        }
    }

    /// Whether the straight lines between the ends of each interval are too far from one another
    /// for a contact, even if the curves bend as far as they may.
    fn is_far(&self) -> bool {
        let [a, b] = self.curves;
        let straight = [a, b].map(|curve| [curve.cubic.position(0.0), curve.cubic.position(1.0)]);
        let bends = a.cubic.bend() + b.cubic.bend();
        closest(straight[0], straight[1]).0 > (self.near * self.reach + bends).powi(2)
    }

    /// Whether a plane lies between both surfaces, whose sections do not turn.
    fn is_parted(&self) -> bool {
        let extent = |k: usize| self.met[k].extent(self.curves[k], self.sides[k].support);
        extent(0).is_clear_of(extent(1), self.near)
    }

    /// Whether two places count as a contact. Places of one yarn count only if they are far enough
    /// from one another along the yarn. Nearer places meet in a fold.
    fn is_apart(&self, place: DVec2) -> bool {
        let ([a, b], [one, other]) = (self.curves, self.parts);
        let reach = [(a, place.x), (b, place.y)].map(|(curve, t)| curve.cubic.at(t).sizes().max_element());
        let window = FRAC_PI_2 * (reach[0] + reach[1]) * one.line.support.extent();
        !self.same || !one.line.within(window, (one.point, place.x), (other.point, place.y))
    }

    fn surfaces(&self) -> [Surface<'a>; 2] {
        [0, 1].map(|k| Surface { side: self.sides[k], rolls: &self.curves[k].rolls })
    }

    /// Calls `start` for each approach of the chords, with parameters from which the approach may
    /// be refined, best first. With `edges`, approaches at an interval's ends also count.
    fn chords(&self, edges: bool, start: impl FnMut([DVec2; 2])) {
        let [first, second] = [0, 1].map(|k| self.met[k].chords(self.curves[k]));
        // Chords may be further from one another than the curves are.
        let within = self.near * self.reach + SAGITTA * self.reach;
        first.approaches(second, within, edges, start);
    }

    /// Adds the nearest place of surfaces that have lobes or turn. They may come near in many
    /// places, whatever the centrelines do.
    fn touching(&self, add: impl FnOnce(DVec2, f64)) {
        let mut all = Vec::new();
        self.chords(false, |starts| all.push(starts[0]));
        let touching = if all.is_empty() {
            None
        } else {
            touch(self.surfaces().each_ref(), &all, |place| self.is_apart(place))
        };
        if let Some((place, ratio)) = touching {
            add(place, ratio);
        }
    }

    /// Adds the nearest places of all other surfaces: `round` ones, `discs`, or smooth ones that do
    /// not turn.
    fn approaches(&self, round: bool, discs: bool, mut add: impl FnMut(DVec2, f64)) {
        let ([a, b], sides, surfaces) = (self.curves, self.sides, self.surfaces());
        let mut seen: Vec<DVec2> = Vec::new();
        let least = Cell::new(f64::INFINITY);
        let valley = Cell::new(false);
        let lost = Cell::new(false);
        let refined = |start: DVec2| {
            let approach = refine(sides[0], sides[1], start);
            least.set(approach.ratio.min(least.get()));
            valley.set(valley.get() || approach.valley);
            let kept = approach.own.is_some_and(|place| self.is_apart(place));
            lost.set(lost.get() || !kept);
            approach.own.map(|place| (place, approach.ratio))
        };
        let mut keep = |(place, ratio): (DVec2, f64)| {
            let again = seen.iter().any(|other| (*other - place).abs().max_element() < ONE_PLACE);
            if ratio <= self.near && !again && self.is_apart(place) {
                seen.push(place);
                add(place, ratio);
            }
        };
        // On one yarn, the control point that two intervals share is nearest of all and hides an
        // approach further along.
        self.chords(self.same && round, |starts| {
            // The first start may lead out of the interval to another approach.
            let reached = starts.into_iter().find_map(|start| match round {
                true => refined(start),
                false if discs => {
                    let near = tubes::nearest(sides[0], sides[1], start)?;
                    Some((DVec2::new(sides[0].own(near.place.x)?, sides[1].own(near.place.y)?), near.ratio))
                }
                false => {
                    touch_near(surfaces.each_ref(), self.near, tubes::nearest(sides[0], sides[1], start)?)
                }
            });
            if let Some(approach) = reached {
                keep(approach);
            }
        });
        // Where the curves approach twice in one valley, the chords may have only one approach.
        while !discs && valley.get() {
            let known = least.get();
            let nearer = nearer(&a.cubic, &b.cubic, known.min(self.near) - CLEARANCE_ACCURACY);
            let Some(start) = nearer else { break };
            refined(start).into_iter().for_each(&mut keep);
            if least.get() >= known {
                break;
            }
        }
        // Where a yarn doubles back, refinement descends to a fold, which is no contact. A contact
        // that it passes on the way may be too shallow for the usual chords.
        if self.same && valley.get() && lost.get() {
            let [first, second] = [a, b].map(|curve| Fine::of(&curve.cubic, SAGITTA_FINE));
            first.approaches(&second, self.near * self.reach, true, |starts| {
                refined(starts[0]).into_iter().for_each(&mut keep);
            });
        }
    }
}
