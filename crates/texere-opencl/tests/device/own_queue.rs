//! A caller with a context and a queue of its own. The backend's kernels run in that queue, and the
//! mesh stays in that context.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "every call of OpenCL is unsafe; handles live to the test's end"
)]

use crate::support::{device, plan, read, waves};
use opencl3::command_queue::{
    CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, CL_QUEUE_PROFILING_ENABLE, CommandQueue,
};
use opencl3::context::Context;
use opencl3::device::{CL_DEVICE_TYPE_ALL, Device};
use opencl3::memory::{Buffer, ClMem};
use opencl3::platform::get_platforms;
use texere_core::backend::{Session, SessionError};
use texere_core::{Backend, BackendError, DeviceInfo, Limits, Pipeline, Settings, Vertex};
use texere_opencl::{OpenClBackend, Schedule};

pub(crate) fn context() -> (Context, Device) {
    // The backend lists the devices first, because the first calls of OpenCL must come from one
    // thread alone.
    OpenClBackend::devices().unwrap();
    let platform = get_platforms().unwrap()[0];
    let device = Device::new(platform.get_devices(CL_DEVICE_TYPE_ALL).unwrap()[0]);
    (Context::from_device(&device).unwrap(), device)
}

pub(crate) fn queue(context: &Context, properties: u64) -> CommandQueue {
    #[allow(deprecated, reason = "OpenCL 1.2, as the backend itself")]
    CommandQueue::create_default(context, properties).unwrap()
}

#[test]
fn a_session_on_a_callers_queue_outlives_the_callers_handles() {
    let yarns = waves();
    let own = device(Schedule::PerRing);
    let expected = Pipeline::new(&yarns).sides(5).caps(true).mesh(&own).unwrap();
    for properties in [CL_QUEUE_PROFILING_ENABLE, 0] {
        let (context, _) = context();
        let queue = queue(&context, properties);
        let device = unsafe { OpenClBackend::on_queue(queue.get(), Schedule::PerRing) }.unwrap();
        let timed_by_device = properties != 0;
        let described = DeviceInfo { name: "opencl".into(), timed_by_device, ..own.info().clone() };
        assert_eq!(device.info(), &described);
        drop((queue, context));
        let mesh = Pipeline::new(&yarns).sides(5).caps(true).mesh(&device).unwrap();
        assert!(mesh.vertices == expected.vertices && mesh.indices == expected.indices);

        let plan = plan(&yarns, Settings::default());
        let mut session = Session::new(&device, plan.clone()).unwrap();
        drop(device);
        session.upload(0, yarns.points()).unwrap();
        session.scan().unwrap();
        session.mesh(&plan.chunks(&Limits::NONE).unwrap().next().unwrap()).unwrap();
        assert!(properties != 0 || session.timings().mesh > std::time::Duration::ZERO);
    }
}

#[test]
fn a_mesh_is_lent_where_it_lies() {
    let yarns = waves();
    let (context, _) = context();
    let queue = queue(&context, 0);
    let device = unsafe { OpenClBackend::on_queue(queue.get(), Schedule::PerRing) }.unwrap();
    let plan = plan(&yarns, Settings::default());
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    let mut session = device.lending_session(plan).unwrap();
    let early = session.device_mesh(&chunk).map(|_| ());
    assert!(matches!(early, Err(SessionError::NotInFlight { chunk: 0 })), "{early:?}");
    session.upload(0, yarns.points()).unwrap();
    session.scan().unwrap();
    session.mesh(&chunk).unwrap();
    let expected = read(&mut session, &chunk);

    let lent = session.device_mesh(&chunk).unwrap();
    let (mut vertices, mut indices) =
        (vec![Vertex::default(); chunk.vertices() as usize], vec![0u32; chunk.indices() as usize]);
    unsafe {
        opencl3::memory::retain_mem_object(lent.vertices).unwrap();
        opencl3::memory::retain_mem_object(lent.indices).unwrap();
        let (from_vertices, from_indices) = (Buffer::new(lent.vertices), Buffer::new(lent.indices));
        assert!(!from_vertices.get().is_null());
        queue.enqueue_read_buffer(&from_vertices, 1, 0, &mut vertices, &[lent.ready]).unwrap();
        queue.enqueue_read_buffer(&from_indices, 1, 0, &mut indices, &[lent.ready]).unwrap();
    }
    assert_eq!((vertices, indices), (expected.0, expected.1));
    assert_eq!(session.traffic().read, u64::from(chunk.vertices()) * 24 + u64::from(chunk.indices()) * 4);
}

#[test]
fn a_queue_out_of_order_is_refused() {
    let (context, _) = context();
    let queue = queue(&context, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
    let refused = unsafe { OpenClBackend::on_queue(queue.get(), Schedule::PerRing) }.map(|_| ());
    let Err(BackendError::Unsupported { what, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(what, "queues that run out of order");
}
