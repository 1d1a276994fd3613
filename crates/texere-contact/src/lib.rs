//! Measures how yarns lie against one another and against themselves. All measures come from the
//! yarns alone, whatever structure they are of.
//!
//! - [`clearance()`]: how near surfaces come to one another, where they pierce, and how tightly
//!   yarns bend.
//! - [`linking()`]: whether yarns have passed through one another on their way from one shape to
//!   another.
//! - [`drawn()`]: whether the tubes of a mesh are [wrung](WRUNG), or triangles face inwards.
//! - [`lengths_mm`]: how long yarns are.
//! - [`yarns_under`]: which yarns lie under a point.
//!
//! A place is a [`YarnPlace`](texere_core::YarnPlace): a yarn, a control interval, and a parameter
//! within the interval.
//!
//! ```
//! use texere_contact::{CLEAR, clearance, length_mm};
//! use texere_core::{ControlPoint, Settings, Yarn, Yarns};
//! // Two straight yarns of radius 0.125 mm that cross 0.1875 mm apart: they pierce.
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.125)));
//! yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|y| ControlPoint::new(0.5, y, 0.1875, 0.125)));
//! let yarns = yarns.build()?;
//! let found = clearance(&yarns, &Settings::default())?;
//! assert!(found.min < CLEAR && found.piercing == 1);
//! assert_eq!(found.worst[0].places.map(|place| place.yarn), [0, 1]);
//! assert_eq!(length_mm(&yarns), 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clearance;
mod drawn;
mod error;
mod grid;
mod length;
mod linking;
mod under;
mod watch;

pub use clearance::{
    CLEAR, CLEARANCE_ACCURACY, CLEARANCE_BESIDE, CLEARANCE_BIN, CLEARANCE_NEAR, CLEARANCE_PAIRS,
    CONTACTS_LISTED, Clearance, Contact, Crowd, bends_up_to, clearance, clearance_up_to,
    clearance_with_progress,
};
pub use drawn::{Drawn, WRUNG, drawn, finer};
pub use error::ContactError;
pub use length::{length_mm, lengths_mm, part_length_mm, round_length_mm};
pub use linking::{LINKING_CHANGE, Linking, Passage, linking, linking_with_progress};
pub use under::yarns_under;
pub use watch::{Report, Watch};
