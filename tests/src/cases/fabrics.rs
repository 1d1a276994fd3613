//! Fabrics of many yarns, of yarns with sections of every kind, and of long yarns.

use texere_core::{ControlPoint, Material, Origin, Section, Yarn, Yarns};

use super::shapes::{self, Shape};

/// Sections of every kind that takes any number of sides.
pub(super) fn sections() -> Vec<(&'static str, Section)> {
    vec![
        ("circle", Section::Circle),
        ("ellipse", Section::Ellipse { aspect: 2.5 }),
        ("ellipse-tall", Section::Ellipse { aspect: 0.3 }),
        ("lens", Section::Lenticular { aspect: 3.0, distortion: 0.0 }),
        ("lens-distorted", Section::Lenticular { aspect: 2.0, distortion: -0.5 }),
        ("lens-tall", Section::Lenticular { aspect: 0.5, distortion: 0.3 }),
        ("power-boxy", Section::PowerEllipse { aspect: 2.0, exponent: 0.4 }),
        ("power-pointed", Section::PowerEllipse { aspect: 1.5, exponent: 1.8 }),
        ("two-ply", Section::plied(2)),
        ("three-ply", Section::plied(3)),
        ("seven-ply", Section::plied(7)),
    ]
}

/// Polygons, which set the number of sides themselves.
pub(super) fn polygons() -> Vec<(&'static str, Vec<[f32; 2]>)> {
    vec![
        ("triangle", vec![[1.0, -0.5], [0.0, 1.0], [-1.0, -0.5]]),
        ("off-axis", vec![[3.0, 1.0], [3.0, 2.0], [2.0, 2.0], [2.0, 1.0]]),
        ("angle", vec![[-1.0, -1.0], [1.0, -1.0], [1.0, -0.25], [-0.25, -0.25], [-0.25, 1.0], [-1.0, 1.0]]),
        (
            "star",
            (0..10)
                .map(|k| {
                    let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 10.0).sin_cos();
                    let out = if k % 2 == 0 { 1.25 } else { 0.5 };
                    [(out * cos) as f32, (out * sin) as f32]
                })
                .collect(),
        ),
    ]
}

/// One shape alone.
pub(super) fn alone(shape: &Shape) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.yarn(shape.yarn, &shape.points);
    yarns.build().unwrap()
}

/// Every shape in one fabric, each with `section`.
pub(super) fn menagerie(section: Section) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.section(section);
    for shape in shapes::all() {
        yarns.yarn(shape.yarn, &shape.points);
    }
    yarns.build().unwrap()
}

/// All shapes that are open, untwisted and nowhere steep, and whose outlines do not lean, in one
/// fabric.
pub(super) fn standing() -> Yarns {
    let mut yarns = Yarns::builder();
    for shape in shapes::all().into_iter().filter(|shape| !shape.yarn.closed && shape.yarn.twist == 0.0) {
        let own = alone(&shape);
        if !own.layout().is_steep(0) && !own.layout().leans() {
            yarns.yarn(shape.yarn, &shape.points);
        }
    }
    yarns.build().unwrap()
}

/// Two yarns like `yarn`, but with the section `section` and with a thickness that varies along
/// them. One yarn has 66 points, more than a block has rings. The other has nine. `flatten` gives
/// the width of each control point, by its number, divided by its height.
pub(super) fn couple(yarn: Yarn, section: Section, flatten: fn(u8) -> f32) -> Yarns {
    let mut yarns = Yarns::builder();
    let yarn = Yarn { section: yarns.section(section), ..yarn };
    for (points, beside) in [(66, 0.0), (9, 40.0)] {
        let slubbed = |(k, point): (u8, &ControlPoint)| {
            let radius = 0.25 + 0.1 * (f32::from(k) * 1.1).sin();
            let flatness = flatten(k).sqrt();
            ControlPoint { x: point.x + beside, ..*point }.flattened(radius * flatness, radius / flatness)
        };
        let points: Vec<_> =
            (0..).zip(winding(points, Yarn { section: 0, ..yarn }).points()).map(slubbed).collect();
        yarns.yarn(yarn, &points);
    }
    yarns.build().unwrap()
}

/// Flattened yarns with up directions that turn along them: open and closed, long and short,
/// twisted and untwisted. Some up directions turn so slowly that an upright frame follows them, and
/// some turn fast.
pub(super) fn leaning() -> Yarns {
    let mut yarns = Yarns::builder();
    let section = yarns.section(Section::Lenticular { aspect: 1.5, distortion: 0.2 });
    let mut ups = Vec::new();
    for (number, fast) in
        [false, true].into_iter().flat_map(|fast| (0..4u8).map(move |number| (number, fast)))
    {
        let closed = number > 1;
        let count = [66_u8, 9, 40, 20][usize::from(number)];
        let beside = 20.0 * f64::from(number) + if fast { 90.0 } else { 0.0 };
        let (mut points, twist) = (Vec::new(), if number % 2 == 0 { 0.3 } else { 0.0 });
        for k in (0..count).map(f64::from) {
            let (sin, cos) = (std::f64::consts::TAU * k / f64::from(count)).sin_cos();
            // An open yarn is a wave, and a closed one a level ring. `across` is level, and at
            // right angles to the yarn.
            let (place, across) = if closed {
                ([6.0 * cos, 6.0 * sin, 0.0], [cos, sin])
            } else {
                ([k, 0.0, 0.4 * (0.5 * k).sin()], [0.0, 1.0])
            };
            let lean = match (closed, fast) {
                (false, false) => 0.04 * k,
                (false, true) => 2.0 * k,
                (true, false) => 0.1 * sin,
                (true, true) => 2.5 * std::f64::consts::TAU * k / f64::from(count),
            };
            ups.push([across[0] * lean.sin(), across[1] * lean.sin(), lean.cos()].map(|value| value as f32));
            let thick = 1.0 + 0.2 * k.sin();
            let point = ControlPoint::new(place[0] as f32, (place[1] + beside) as f32, place[2] as f32, 0.1);
            points.push(point.flattened((0.3 * thick) as f32, (0.1 * thick) as f32));
        }
        yarns.yarn(Yarn { section, closed, twist, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap().with_ups(ups).unwrap()
}

/// The corners of a wheel whose teeth are one corner each.
pub(super) fn cog(corners: u32) -> Vec<[f32; 2]> {
    let corner = |k: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(corners)).sin_cos();
        let out = if k.is_multiple_of(2) { 1.1 } else { 0.85 };
        [(out * cos) as f32, (out * sin) as f32]
    };
    (0..corners).map(corner).collect()
}

/// Yarns of several materials and sections: open and closed, twisted and untwisted, long and short.
pub(super) fn mixed() -> Yarns {
    let mut yarns = Yarns::builder();
    let materials = ["cotton", "wool", "silk"]
        .map(|name| yarns.material(Material { name: name.into(), ..Material::default() }));
    let sections: Vec<_> = sections().into_iter().map(|(_, section)| yarns.section(section)).collect();
    for (number, shape) in shapes::all().into_iter().enumerate() {
        let yarn = Yarn {
            material: materials[number * 2 % 3],
            section: sections[number * 5 % sections.len()],
            origin: Origin::End(number as u32 + 1),
            twist: if number % 3 == 0 { 0.25 * number as f32 } else { shape.yarn.twist },
            ..shape.yarn
        };
        yarns.yarn(yarn, &shape.points);
    }
    yarns.build().unwrap()
}

/// Yarns that wander about without sharp turns, open and closed. They are the same on every run.
pub(super) fn wandering() -> Yarns {
    // The quick generator of Numerical Recipes. Its high bits suffice for a walk.
    let mut state = 3u32;
    let mut random = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let mut yarns = Yarns::builder();
    for number in 0..60 {
        let middle = [random(), random(), random()].map(|value| value * 20.0);
        let points: Vec<_> = (0..20)
            .map(|k| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 20.0).sin_cos();
                let out = 6.0 + random();
                let [x, y, z] = [middle[0] + out * cos, middle[1] + out * sin, middle[2] + 2.0 * random()];
                ControlPoint::new(x as f32, y as f32, z as f32, (0.1 + 0.3 * random()) as f32)
            })
            .collect();
        let twist = (random() * 4.0 - 2.0) as f32;
        yarns.yarn(Yarn { closed: number % 2 == 1, twist, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// Ten thousand yarns of two points.
pub(super) fn many_short() -> Yarns {
    let mut yarns = Yarns::builder();
    for k in 0..10_000u16 {
        let (x, y) = (f32::from(k % 100), f32::from(k / 100));
        let ends = [ControlPoint::new(x, y, 0.0, 0.2), ControlPoint::new(x + 0.5, y + 0.25, 0.5, 0.1)];
        yarns.yarn(Yarn { origin: Origin::Pick(k.into()), ..Yarn::default() }, &ends);
    }
    yarns.build().unwrap()
}

/// One gently winding yarn of `points` points.
pub(super) fn winding(points: u32, yarn: Yarn) -> Yarns {
    let at = |k: u32| {
        let (sin, cos) = (f64::from(k) * 0.37).sin_cos();
        let (slow_sin, slow_cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(points)).sin_cos();
        let out = f64::from(points) / 6.0 + sin;
        ControlPoint::new((out * slow_cos) as f32, (out * slow_sin) as f32, cos as f32, 0.25)
    };
    let points: Vec<_> = (0..points).map(at).collect();
    let mut yarns = Yarns::builder();
    yarns.yarn(yarn, &points);
    yarns.build().unwrap()
}

/// The fabric with every length multiplied by `scale`.
pub(super) fn scaled(yarns: &Yarns, scale: f32) -> Yarns {
    let grow = |point: &ControlPoint| {
        ControlPoint { x: point.x * scale, y: point.y * scale, z: point.z * scale, ..*point }
            .flattened(point.half_width() * scale, point.half_height() * scale)
    };
    let points = yarns.points().iter().map(grow).collect();
    Yarns::new(yarns.layout().as_ref().clone(), yarns.materials().to_vec(), points).unwrap()
}
