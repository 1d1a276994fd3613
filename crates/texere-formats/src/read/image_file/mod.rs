//! Image files: PNG, BMP and TIFF. A build without images refuses them by name.

#[cfg(not(feature = "images"))]
mod absent;
#[cfg(feature = "images")]
mod bmp;
#[cfg(feature = "images")]
mod bytes;
#[cfg(feature = "images")]
mod decode;
mod image;
#[cfg(feature = "images")]
mod limits;
#[cfg(feature = "images")]
mod png;
#[cfg(feature = "images")]
mod refused;
#[cfg(feature = "images")]
mod tiff;

#[cfg(not(feature = "images"))]
pub(super) use absent::decode;
#[cfg(feature = "images")]
pub(super) use decode::decode;
