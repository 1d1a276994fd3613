//! A window that shows a textile design as yarns.
//!
//! ```text
//! design file ──> workshop, a thread ──> scene ──> window ──> picture
//!                      └──<── orders: lifts, colours, sides, tension ──<──┘
//! ```
//!
//! Every triangle is drawn for each picture, from control points on the device. The pointer turns,
//! moves and zooms the cloth, and the yarn under the pointer is named as a weaver or a knitter
//! calls it. A click can change a lift. When the design's file changes, the cloth is made again.

mod canvas;
mod device;
mod error;
mod event;
mod messages;
mod orbit;
mod panel;
#[cfg(test)]
mod rest_tests;
mod view;
mod watch;
mod window;
mod workshop;

pub use error::ViewError;
pub use event::Event;
pub use view::View;
