//! Devices that are found, named, refused or lost, and a caller's own devices.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod support;

use texere_conformance::drive::Lent;
use texere_conformance::{cases, check};
use texere_core::backend::{Session, SessionError};
use texere_core::{Backend, BackendError, Frame, Limits, Settings, Yarn};
use texere_wgpu::{Schedule, WgpuBackend, WgpuSession};

use support::{INSTALL, backend, plan, waves};

/// A device without any feature, as a viewer might open it.
fn callers_device(limits: wgpu::Limits) -> (wgpu::Device, wgpu::Queue) {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).expect(INSTALL);
    pollster::block_on(
        adapter.request_device(&wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() }),
    )
    .expect(INSTALL)
}

#[test]
fn devices_are_numbered_and_described() {
    let devices = WgpuBackend::devices().expect(INSTALL);
    for (index, device) in devices.iter().enumerate() {
        assert_eq!(device.name, format!("wgpu:{index}"));
        assert!(!device.device.is_empty() && device.limits.binding_bytes >= 128 << 20, "{device:?}");
    }
    assert_eq!(backend().info(), &devices[0]);
    let part = devices[0].device.to_uppercase();
    assert_eq!(WgpuBackend::open_named(&part, Schedule::PerRing).expect(INSTALL).info(), &devices[0]);
}

#[test]
fn a_device_that_is_not_there_is_named_with_those_that_are() {
    for error in
        [WgpuBackend::open(99, Schedule::PerRing), WgpuBackend::open_named("Voodoo 2", Schedule::PerRing)]
    {
        let Err(BackendError::NoDevice { wanted, found }) = error else { panic!("{error:?}") };
        assert!(wanted == "wgpu:99" || wanted == "Voodoo 2");
        assert!(found[0].starts_with("wgpu:0 ("), "{found:?}");
    }
}

#[test]
fn the_serial_schedule_is_a_hosts() {
    let refused = WgpuBackend::open(0, Schedule::Serial).unwrap_err();
    assert_eq!(refused.to_string(), "wgpu:0 does not do the serial schedule");
}

#[test]
fn a_callers_device_does_as_well() {
    let (device, queue) = callers_device(wgpu::Limits::default());
    let backend = WgpuBackend::from_device(device.clone(), queue, Schedule::PerRing).unwrap();
    assert_eq!(backend.info().name, "wgpu");
    assert_eq!(backend.info().limits.binding_bytes, 128 << 20);
    for frame in [Frame::Upright, Frame::RotationMinimizing] {
        let settings = Settings { caps: true, sides: 7, frame, ..Settings::default() };
        let report = check(&cases::mixed(), settings, &backend, false).unwrap();
        assert!(report.is_clean(), "{report}");
    }

    // No timestamp queries were asked for, so the host's clock is used.
    let yarns = waves(3, 50, Yarn::default());
    let plan = plan(&yarns, Settings::default());
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    let mut session = backend.lending_session(plan.clone()).unwrap();
    assert!(!backend.info().timed_by_device);
    session.upload(0, yarns.points()).unwrap();
    session.mesh(&chunk).unwrap();
    assert!(session.timings().mesh > std::time::Duration::ZERO);

    // The caller's own work on the queue reads the mesh without a wait.
    let vertices = session.vertex_buffer(&chunk).unwrap().clone();
    let indices = session.index_buffer(&chunk).unwrap().clone();
    assert!(vertices.usage().contains(wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC));
    assert!(indices.usage().contains(wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_SRC));
    let own = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(chunk.vertices()) * 24,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(&vertices, 0, &own, 0, own.size());
    backend.queue().submit([encoder.finish()]);
    own.map_async(wgpu::MapMode::Read, .., |answer| answer.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let copied = own.get_mapped_range(..).unwrap().to_vec();
    assert_eq!(copied, bytemuck::cast_slice::<_, u8>(&Lent::read(&mut session, &chunk).unwrap().vertices));
}

#[test]
fn a_callers_device_of_too_narrow_limits_is_refused_with_the_drivers_log() {
    let limits = wgpu::Limits { max_storage_buffers_per_shader_stage: 4, ..wgpu::Limits::default() };
    let (device, queue) = callers_device(limits);
    let refused = WgpuBackend::from_device(device, queue, Schedule::PerRing);
    let Err(BackendError::Compile { kernel, log }) = refused else { panic!("{refused:?}") };
    assert_eq!(kernel, "trajectory");
    assert!(log.contains("max_storage_buffers_per_shader_stage") || log.contains("storage buffers"), "{log}");
}

/// Tests the results of calls after the device is lost. At least one of the calls reports the loss.
/// Each other call succeeds, reports the loss, too, or is refused because the stage that it depends
/// on has not run. No call may panic, nor may the drop at the end.
fn assert_lost(mut session: WgpuSession, yarns: &texere_core::Yarns, chunk: &texere_core::backend::Chunk) {
    let errors = [
        session.upload(0, yarns.points()),
        session.scan(),
        session.trajectory(chunk),
        session.mesh(chunk),
        session.read_mesh(chunk, &mut |_| std::ops::ControlFlow::Continue(())).map(|_| ()),
    ];
    let lost = errors
        .iter()
        .filter(|error| matches!(error, Err(SessionError::Backend(BackendError::DeviceLost { .. }))))
        .count();
    assert!(lost > 0, "{errors:?}");
    for error in errors {
        assert!(
            matches!(
                error,
                Ok(())
                    | Err(SessionError::Backend(BackendError::DeviceLost { .. })
                        | SessionError::OutOfOrder { .. }
                        | SessionError::NotInFlight { .. })
            ),
            "{error:?}"
        );
    }
    let _ = (session.timings(), session.traffic());
}

#[test]
fn a_lost_device_is_an_error_and_never_a_panic() {
    // The first yarns are so short that their control points go through wgpu's own staging. The
    // second are sent in pieces.
    for points in [500, 50_000] {
        lose_a_device_with(&waves(3, points, Yarn { twist: 0.5, ..Yarn::default() }));
    }
}

fn lose_a_device_with(yarns: &texere_core::Yarns) {
    let plan = plan(yarns, Settings::default());
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    let (device, queue) = callers_device(wgpu::Limits::default());
    let callers = WgpuBackend::from_device(device, queue, Schedule::PerRing).unwrap();
    let own = WgpuBackend::open(0, Schedule::PerRing).expect(INSTALL);
    for backend in [own, callers] {
        let mut session = backend.lending_session(plan.clone()).unwrap();
        session.upload(0, yarns.points()).unwrap();
        session.scan().unwrap();
        session.mesh(&chunk).unwrap();
        backend.device().destroy();
        assert_lost(session, yarns, &chunk);
        assert!(Session::new(&backend, plan.clone()).is_err());
    }
    // A new device works.
    let mut session =
        WgpuBackend::open(0, Schedule::PerRing).expect(INSTALL).lending_session(plan.clone()).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.scan().unwrap();
    session.mesh(&chunk).unwrap();
    assert_eq!(Lent::read(&mut session, &chunk).unwrap().vertices.len(), chunk.vertices() as usize);
}
