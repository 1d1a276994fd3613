//! An edited fabric equals one that is made anew, on every backend. Edits are of lifts, yarns,
//! colours, stitches and tension, and of yarns that come to rest. Edits of woven cloth are also
//! taken back.

use std::ops::ControlFlow;
use std::sync::{Arc, OnceLock};

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use texere::backend::Plan;
use texere::mesh::{Frame, LiveError, MeshPiece, Ray};
use texere::weft::{Beds, Cell, Chart, Gauge, KnitYarn, Knitted, Machine};
use texere::woven::{Drawdown, Relief, Thread, Woven, WovenDesign};
use texere::yarn::{Material, Section, YarnError};
use texere::{
    Backend, ControlPoint, Design, Live, Picker, Pipeline, Settings, Structure, Vertex, Yarn, Yarns,
};
use texere_conformance::editing_devices;

const ENDS: usize = 23;
const PICKS: usize = 17;

#[derive(Debug, Clone)]
enum Edit {
    Lift {
        end: usize,
        pick: usize,
        up: bool,
    },
    Block {
        end: usize,
        pick: usize,
        bits: u64,
    },
    Yarn {
        yarn: usize,
        twist: f32,
        lower: f32,
        left_out: usize,
    },
    Colour {
        material: usize,
        srgb: [u8; 3],
    },
    /// All yarns move as if they had settled, except those whose number is a multiple of
    /// `multiple`.
    Rest {
        lower: f32,
        multiple: usize,
    },
    /// The previous edit is taken back.
    Undo,
    Update,
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        4 => (0..ENDS, 0..PICKS, any::<bool>()).prop_map(|(end, pick, up)| Edit::Lift { end, pick, up }),
        1 => (0..ENDS - 8, 0..PICKS - 8, any::<u64>()).prop_map(|(end, pick, bits)| Edit::Block { end, pick, bits }),
        2 => (0..ENDS + PICKS, -2.0f32..2.0, -0.5f32..0.5, 0usize..9)
            .prop_map(|(yarn, twist, lower, left_out)| Edit::Yarn { yarn, twist, lower, left_out }),
        1 => (0usize..2, any::<[u8; 3]>()).prop_map(|(material, srgb)| Edit::Colour { material, srgb }),
        1 => (-0.1f32..0.1, 2usize..6).prop_map(|(lower, multiple)| Edit::Rest { lower, multiple }),
        2 => Just(Edit::Undo),
        1 => Just(Edit::Update),
    ]
}

fn cloth(bits: u64, twist: f32, selvedge: bool) -> Woven {
    let drawdown =
        Drawdown::from_fn(ENDS, PICKS, |end, pick| bits >> ((end * 5 + pick * 3) % 64) & 1 == 1).unwrap();
    let thread = |number: usize| Thread {
        material: (number / 6 % 2) as u32,
        twist,
        ..Thread::new([1.0, 1.0, 2.2][number % 3], 0.2)
    };
    let [warp, weft] = [ENDS, PICKS].map(|count| (0..count).map(thread).collect());
    let mut cloth =
        Woven::new(drawdown, warp, weft, vec![Material::default(); 2], vec![Section::Circle]).unwrap();
    cloth.set_selvedge(selvedge);
    cloth
}

/// The test's own record of the fabric: the weave, all yarns as they now lie, and the materials.
#[derive(Clone, PartialEq)]
struct Model {
    cloth: Woven,
    yarns: Vec<(Yarn, Vec<ControlPoint>)>,
    materials: Vec<Material>,
}

impl Model {
    fn new(cloth: Woven) -> Self {
        let yarns = yarns_of(&cloth.yarns().unwrap());
        Self { materials: cloth.materials().to_vec(), yarns, cloth }
    }

    /// Weaves the cloth with other lifts. Yarns whose woven path this changes lie as woven again.
    fn lift(&mut self, lifts: &[(usize, usize, bool)]) {
        let before = yarns_of(&self.cloth.yarns().unwrap());
        let drawdown = self.cloth.drawdown().clone();
        let up = |end, pick| {
            let lift = lifts.iter().find(|lift| (lift.0, lift.1) == (end, pick));
            lift.map_or(drawdown.up(end, pick), |lift| lift.2)
        };
        let changed = Drawdown::from_fn(ENDS, PICKS, up).unwrap();
        let [warp, weft] = [self.cloth.warp(), self.cloth.weft()].map(<[_]>::to_vec);
        let selvedge = self.cloth.selvedge();
        self.cloth =
            Woven::new(changed, warp, weft, self.cloth.materials().to_vec(), vec![Section::Circle]).unwrap();
        self.cloth.set_selvedge(selvedge);
        for (yarn, (before, after)) in before.iter().zip(yarns_of(&self.cloth.yarns().unwrap())).enumerate() {
            if *before != after {
                self.yarns[yarn] = after;
            }
        }
    }

    fn yarns(&self) -> Yarns {
        let mut yarns = Yarns::builder();
        self.materials.iter().for_each(|material| {
            yarns.material(material.clone());
        });
        yarns.section(Section::Circle);
        for (what, points) in &self.yarns {
            yarns.yarn(*what, points);
        }
        yarns.build().unwrap()
    }
}

fn yarns_of(yarns: &Yarns) -> Vec<(Yarn, Vec<ControlPoint>)> {
    let points = |yarn| yarns.yarn_points(yarn).unwrap().to_vec();
    yarns.layout().yarns().iter().enumerate().map(|(yarn, what)| (*what, points(yarn))).collect()
}

/// Applies an edit to `live` and to `model`.
fn apply(live: &mut Live, model: &mut Model, edit: &Edit) {
    match *edit {
        Edit::Lift { end, pick, up } => {
            live.set_lift(end, pick, up).unwrap();
            model.lift(&[(end, pick, up)]);
        }
        Edit::Block { end, pick, bits } => {
            let up = |e: usize, p: usize| bits >> ((p - pick) * 8 + (e - end)) & 1 == 1;
            live.set_drawdown(end..end + 8, pick..pick + 8, up).unwrap();
            let all = (pick..pick + 8).flat_map(|p| (end..end + 8).map(move |e| (e, p)));
            model.lift(&all.map(|(e, p)| (e, p, up(e, p))).collect::<Vec<_>>());
        }
        Edit::Yarn { yarn, twist, lower, left_out } => {
            let yarn = yarn % model.yarns.len();
            let (what, points) = &mut model.yarns[yarn];
            what.twist = twist;
            points.iter_mut().for_each(|point| point.z -= lower);
            // 0 keeps all points, and 1 makes them twice as many. Any larger number n leaves out
            // each point whose number, counted from 1, is a multiple of n + 1, if there are more
            // than six.
            match left_out {
                0 => {}
                1 => {
                    *points =
                        points.iter().flat_map(|point| [*point, ControlPoint { z: 1.0, ..*point }]).collect()
                }
                each if points.len() > 6 => {
                    let mut number = 0;
                    points.retain(|_| {
                        number += 1;
                        number % (each + 1) > 0
                    });
                }
                _ => {}
            }
            live.set_yarn(yarn, *what, points).unwrap();
        }
        Edit::Colour { material, srgb } => {
            let coloured = Material { srgb, ..model.materials[material].clone() };
            live.set_material(material, coloured.clone()).unwrap();
            model.materials[material] = coloured;
        }
        Edit::Rest { lower, multiple } => {
            for (_, points) in
                model.yarns.iter_mut().enumerate().filter(|(yarn, _)| yarn % multiple > 0).map(|(_, own)| own)
            {
                points.iter_mut().for_each(|point| (point.x, point.z) = (point.x + 0.1, point.z - lower));
            }
            live.set_rest(&model.yarns()).unwrap();
        }
        Edit::Undo | Edit::Update => {}
    }
}

/// Sets all lifts, yarns and colours to those of a model.
fn go_back(live: &mut Live, now: &mut Model, to: &Model) {
    let drawdown = to.cloth.drawdown();
    live.set_drawdown(0..ENDS, 0..PICKS, |end, pick| drawdown.up(end, pick)).unwrap();
    for (yarn, (what, points)) in to.yarns.iter().enumerate() {
        live.set_yarn(yarn, *what, points).unwrap();
    }
    for (number, material) in to.materials.iter().enumerate() {
        live.set_material(number, material.clone()).unwrap();
    }
    now.clone_from(to);
}

/// The triangles of each yarn by their corners, in a fixed order.
fn triangles(live: &mut Live) -> Vec<Vec<[Vertex; 3]>> {
    let mesh = live.mesh_mut();
    let plan = mesh.plan().clone();
    let mut yarns = vec![Vec::new(); plan.layout().yarns().len()];
    for (number, chunk) in mesh.chunks().to_vec().iter().enumerate() {
        let mut vertices = vec![Vertex::default(); chunk.vertices() as usize];
        let mut indices = vec![0; chunk.indices() as usize];
        let _ = mesh
            .read_mesh(number, &mut |piece| {
                match piece {
                    MeshPiece::Vertices { first, vertices: lent } => {
                        vertices[first as usize..][..lent.len()].copy_from_slice(lent);
                    }
                    MeshPiece::Indices { first, indices: lent } => {
                        indices[first as usize..][..lent.len()].copy_from_slice(lent);
                    }
                    _ => {}
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        for draw in plan.chunk_draws(chunk) {
            let range = draw.indices.start as usize..draw.indices.end as usize;
            let corners = |of: &[u32]| [0, 1, 2].map(|at| vertices[of[at] as usize]);
            yarns[draw.yarn as usize].extend(indices[range].chunks_exact(3).map(corners));
        }
    }
    sorted(yarns)
}

fn fresh(yarns: &Yarns, settings: Settings, device: &dyn Backend) -> Vec<Vec<[Vertex; 3]>> {
    let mesh = Pipeline::new(yarns).settings(settings).mesh(device).unwrap();
    let mut all = vec![Vec::new(); yarns.layout().yarns().len()];
    for draw in mesh.draws() {
        let range = draw.indices.start as usize..draw.indices.end as usize;
        let corners =
            |of: &[u32]| [0, 1, 2].map(|at| mesh.vertices[draw.base_vertex as usize + of[at] as usize]);
        all[draw.yarn as usize].extend(mesh.indices[range].chunks_exact(3).map(corners));
    }
    sorted(all)
}

fn sorted(mut yarns: Vec<Vec<[Vertex; 3]>>) -> Vec<Vec<[Vertex; 3]>> {
    for yarn in &mut yarns {
        yarn.sort_by(|one: &[Vertex; 3], other| bytemuck::bytes_of(one).cmp(bytemuck::bytes_of(other)));
    }
    yarns
}

/// All devices, opened once.
fn devices() -> &'static [Arc<dyn Backend>] {
    static DEVICES: OnceLock<Vec<Arc<dyn Backend>>> = OnceLock::new();
    DEVICES.get_or_init(|| {
        let (devices, missing) = editing_devices();
        assert!(missing.is_empty(), "{missing:?}");
        devices
    })
}

/// A ray down onto the cloth: a different one for each number below 100.
fn above(number: u32) -> Ray {
    let [x, y] = [number % 10, number / 10].map(|step| f64::from(step) * 2.3 + 0.4);
    Ray { origin: [x, y, 9.0], direction: [0.0, 0.05, -1.0] }
}

/// Over a thousand edits on every device.
#[test]
fn edited_cloth_ends_as_cloth_woven_anew() {
    for device in devices() {
        let mut runner =
            TestRunner::new(Config { cases: 32, failure_persistence: None, ..Config::default() });
        let case = (any::<u64>(), any::<bool>(), any::<bool>(), prop::collection::vec(edit(), 1..80));
        let ran = runner.run(&case, |(bits, turned, selvedge, edits)| {
            let settings = Settings { frame: Frame::RotationMinimizing, caps: turned, ..Settings::default() };
            let cloth = cloth(bits, if turned { 1.0 } else { 0.0 }, selvedge);
            let mut model = Model::new(cloth.clone());
            let mut live = Live::weave(device.clone(), cloth, settings).unwrap();
            // From the first ray on, edits also update the picker.
            let _ = live.pick(&above(0)).unwrap();
            let mut past = Vec::new();
            for edit in &edits {
                match edit {
                    Edit::Undo => {
                        if let Some(before) = past.pop() {
                            go_back(&mut live, &mut model, &before);
                        }
                    }
                    Edit::Update => {
                        live.update().unwrap();
                    }
                    _ => {
                        past.push(model.clone());
                        apply(&mut live, &mut model, edit);
                    }
                }
            }
            live.update().unwrap();
            let wanted = model.yarns();
            prop_assert_eq!(live.materials(), &model.materials[..]);
            prop_assert!(yarns_of(&live.yarns().unwrap()) == yarns_of(&wanted));
            let plan = Arc::new(Plan::new(wanted.layout().clone(), settings).unwrap());
            let picker = Picker::new(plan, wanted.points()).unwrap();
            for ray in (0..100).map(above) {
                prop_assert_eq!(live.pick(&ray).unwrap(), picker.pick(&ray));
            }
            let (made, wanted) = (triangles(&mut live), fresh(&wanted, settings, &**device));
            let differs = made.iter().zip(&wanted).position(|(made, wanted)| made != wanted);
            prop_assert_eq!(differs, None, "on {}", &device.info().name);
            Ok(())
        });
        ran.unwrap();
    }
}

fn knit(chart: &Chart) -> Structure {
    let stitches = Machine::default().knit(&chart.program().unwrap()).unwrap().stitches;
    let yarns = vec![KnitYarn::new(0.1)];
    let knit = Knitted::new(
        stitches,
        Gauge::new(1.0, 0.75),
        yarns,
        vec![Material::default()],
        vec![Section::Circle],
        [3, 3],
    );
    Structure::Weft(knit.unwrap())
}

/// Stitches change the number of a yarn's control points, and sometimes the number of yarns.
#[test]
fn a_knit_takes_other_stitches() {
    let settings = Settings::default();
    for device in devices() {
        let mut runner = TestRunner::new(Config { cases: 8, failure_persistence: None, ..Config::default() });
        let edits = prop::collection::vec((0usize..6, 0usize..5, 0usize..4), 1..24);
        let ran = runner.run(&edits, |edits| {
            let mut chart = Chart::parse("kkkkkk\nkkkkkk\nkkkkkk\nkkkkkk\nkkkkkk", Beds::One).unwrap();
            let mut live = Live::new(device.clone(), &knit(&chart), settings).unwrap();
            for (wale, course, cell) in edits {
                let cell = [Cell::Knit, Cell::Purl, Cell::Tuck, Cell::Miss][cell];
                if chart.set(wale, course, cell).is_ok() {
                    live.set_structure(&knit(&chart)).unwrap();
                    live.update().unwrap();
                }
            }
            live.update().unwrap();
            let wanted = fresh(&knit(&chart).yarns().unwrap(), settings, &**device);
            prop_assert!(triangles(&mut live) == wanted, "{:?}", chart);
            Ok(())
        });
        ran.unwrap();
    }
}

/// A lift changes two yarns, and only these are sent.
#[test]
fn a_lift_makes_two_yarns_again() {
    let device: Arc<dyn Backend> = Arc::from(texere::open("cpu").unwrap());
    let mut live = Live::weave(device, cloth(0x5555, 0.0, false), Settings::default()).unwrap();
    live.update().unwrap();
    let sent = live.mesh().traffic().uploaded;
    live.set_lift(4, 9, !live.woven().unwrap().drawdown().up(4, 9)).unwrap();
    let offsets = live.mesh().plan().layout().offsets();
    let padded: u64 = [4, ENDS + 9].map(|yarn| offsets[yarn + 1] - offsets[yarn] + 2).iter().sum();
    assert_eq!(live.mesh().traffic().uploaded - sent, padded * 16);
    let update = live.update().unwrap();
    let rings: u32 = [4, ENDS + 9].map(|yarn| live.mesh().plan().rings(yarn)).iter().sum();
    let vertices: u32 = update.changes.iter().map(|change| change.vertices.len() as u32).sum();
    assert_eq!((vertices, update.anew), (rings * 6, false));
}

/// A cloth is shown as woven, and then at rest. The two yarns of a later lift lie as woven, among
/// yarns at rest.
#[test]
fn cloth_at_rest_keeps_its_weave() {
    let threads = |count| vec![Thread::new(0.35, 0.15); count];
    let plain = Drawdown::from_fn(12, 8, |end, pick| (end + pick) % 2 == 0).unwrap();
    let cloth =
        Woven::new(plain, threads(12), threads(8), vec![Material::default()], vec![Section::Circle]).unwrap();
    let structure = Structure::Woven(WovenDesign::new(cloth, None, Relief::Report).unwrap());
    let settings = Settings::default();
    let device: Arc<dyn Backend> = Arc::from(texere::open("cpu").unwrap());
    let mut live = Live::new(device.clone(), &structure, settings).unwrap();
    let rest = Design::of("Plain weave", structure).rest(&*device).run().unwrap();
    live.set_rest(rest.yarns()).unwrap();
    live.update().unwrap();
    assert!(triangles(&mut live) == fresh(rest.yarns(), settings, &*device));
    let up = live.woven().unwrap().drawdown().up(3, 2);
    live.set_lift(3, 2, !up).unwrap();
    let update = live.update().unwrap();
    let rings: u32 = [3, 12 + 2].map(|yarn| live.mesh().plan().rings(yarn)).iter().sum();
    assert_eq!(update.changes.iter().map(|change| change.vertices.len() as u32).sum::<u32>(), rings * 6);
    let woven = yarns_of(&live.woven().unwrap().yarns().unwrap());
    for (yarn, now) in yarns_of(&live.yarns().unwrap()).into_iter().enumerate() {
        let wanted = if [3, 14].contains(&yarn) { &woven[yarn] } else { &yarns_of(rest.yarns())[yarn] };
        assert!(now == *wanted, "yarn {yarn}");
    }
}

/// Edited yarns have the tension of the fabric. Yarns with another tension are refused.
#[test]
fn edits_keep_the_tension_of_the_fabric() {
    let settings = Settings::default();
    for device in editing_devices().0 {
        let mut live = Live::weave(device.clone(), cloth(0x5555, 0.0, false), settings).unwrap();
        live.update().unwrap();
        live.set_tension(0.3).unwrap();
        let up = live.woven().unwrap().drawdown().up(3, 2);
        live.set_lift(3, 2, !up).unwrap();
        assert!(live.update().unwrap().anew);
        let slack = live.woven().unwrap().yarns().unwrap();
        let taut = slack.clone().with_tension(0.3).unwrap();
        assert!(triangles(&mut live) == fresh(&taut, settings, &*device));
        assert_eq!([live.yarns().unwrap().tension(), live.only(3).unwrap().tension()], [0.3; 2]);
        let is_refused = |refused: Result<(), LiveError>| {
            let wanted = YarnError::OtherTension { given: 0.0, tension: 0.3 };
            matches!(refused, Err(LiveError::Yarns(error)) if error == wanted)
        };
        assert!(is_refused(live.set_rest(&slack)) && is_refused(live.set_yarns(slack)));
        assert!(matches!(live.set_tension(f32::NAN), Err(LiveError::Yarns(YarnError::Tension { .. }))));
        // The yarns of another structure get the tension, too.
        let of_weave = |cloth| Structure::Woven(WovenDesign::new(cloth, None, Relief::Report).unwrap());
        live.set_structure(&of_weave(cloth(0x3333, 0.0, false))).unwrap();
        assert!(live.update().is_ok());
        let taut = cloth(0x3333, 0.0, false).yarns().unwrap().with_tension(0.3).unwrap();
        assert!(triangles(&mut live) == fresh(&taut, settings, &*device));
    }
}

#[test]
fn what_can_not_be_is_named() {
    let device: Arc<dyn Backend> = Arc::from(texere::open("cpu").unwrap());
    let mut live = Live::weave(device.clone(), cloth(0x5555, 0.0, false), Settings::default()).unwrap();
    assert!(matches!(live.set_lift(ENDS, 0, true), Err(LiveError::Fabric(_))));
    let point = ControlPoint::new(0.0, 0.0, 0.0, 0.1);
    assert!(matches!(live.set_points(40, &[point; 4]), Err(LiveError::NoYarn { yarn: 40, yarns: 40 })));
    let nowhere = ControlPoint { x: f32::NAN, ..point };
    assert!(matches!(live.set_points(3, &[nowhere; 400]), Err(LiveError::Session(_))));
    assert!(matches!(live.set_material(2, Material::default()), Err(LiveError::NoMaterial { .. })));
    let fewer = live.yarns().unwrap().only(0..39).unwrap();
    let refused = live.set_rest(&fewer);
    assert!(matches!(refused, Err(LiveError::OtherYarns { given: 39, yarns: 40, .. })), "{refused:?}");
    // The refused edits have changed nothing.
    assert!(yarns_of(&live.yarns().unwrap()) == yarns_of(&cloth(0x5555, 0.0, false).yarns().unwrap()));
    let mut given = Live::given(device, live.yarns().unwrap(), Settings::default()).unwrap();
    assert!(matches!(given.set_lift(0, 0, true), Err(LiveError::NotWoven)));
}
