//! A caller, which draws random handles, texts and numbers, valid and invalid.

use std::ffi::c_char;
use std::path::Path;
use std::ptr::{null, null_mut, without_provenance_mut};
use std::sync::Mutex;

use texere_c::texere_status::{self, TEXERE_ARGUMENT, TEXERE_OK, TEXERE_PANIC};

use crate::common::{message, sized};
use crate::kinds::{KINDS, Kind, free};
use crate::operations::Operation;

/// Random numbers (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014:
/// SplitMix).
#[derive(Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// The random numbers for sequence `number`.
    pub(crate) fn of(seed: u64, number: u64) -> Self {
        let mut random = Self(seed ^ number.wrapping_mul(0xd134_2543_de82_ef95));
        random.next();
        random
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// A number below `limit`.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    pub(crate) fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    pub(crate) fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    /// A number near `usual`, and sometimes a number that few functions accept.
    pub(crate) fn number(&mut self, usual: f64) -> f64 {
        if self.one_in(40) {
            return self.pick(&[0.0, -1.0, f64::NAN, f64::INFINITY, 1e30, 1e-30, -1e9]);
        }
        usual * (0.8 + 0.4 * (self.next() as f64 / u64::MAX as f64))
    }

    /// One of the first `count` numbers, and sometimes another one.
    pub(crate) fn choice(&mut self, count: u32) -> u32 {
        if self.one_in(40) { self.pick(&[count, 99, u32::MAX]) } else { self.below(count as usize) as u32 }
    }
}

/// Handles that callers share: the live ones by kind, and those that were freed.
pub(crate) struct Pool {
    live: [Mutex<Vec<usize>>; KINDS],
    freed: Mutex<Vec<usize>>,
    /// Whether other threads free handles, too. Then no handle is certain to be live.
    is_shared: bool,
}

/// How many freed handles the pool keeps at most.
const FREED: usize = 64;

/// How many live handles of each kind a shared pool keeps.
const KEPT: usize = 8;

impl Pool {
    pub(crate) fn new(is_shared: bool) -> Self {
        Self { live: [const { Mutex::new(Vec::new()) }; KINDS], freed: Mutex::default(), is_shared }
    }

    pub(crate) fn add(&self, kind: usize, handle: usize) {
        self.live[kind].lock().unwrap().push(handle);
    }

    /// A live handle of a kind, if there is one.
    fn any(&self, kind: usize, random: &mut Random) -> Option<usize> {
        let live = self.live[kind].lock().unwrap();
        (!live.is_empty()).then(|| live[random.below(live.len())])
    }

    /// Notes that a handle was freed as one of `kind`. The handle may be of another kind.
    pub(crate) fn note_freed(&self, kind: usize, handle: usize) {
        let mut live = self.live[kind].lock().unwrap();
        if let Some(place) = live.iter().position(|other| *other == handle) {
            live.swap_remove(place);
            let mut freed = self.freed.lock().unwrap();
            freed.push(handle);
            if freed.len() > FREED {
                freed.swap_remove(0);
            }
        }
    }

    pub(crate) fn free_all(&self) {
        self.free_down_to(0);
    }

    pub(crate) fn free_most(&self) {
        self.free_down_to(KEPT);
    }

    fn free_down_to(&self, kept: usize) {
        for kind in 0..KINDS {
            loop {
                let mut live = self.live[kind].lock().unwrap();
                let Some(handle) = (live.len() > kept).then(|| live.swap_remove(0)) else { break };
                drop(live);
                free(kind, handle);
            }
        }
    }
}

/// A text as the library takes it: a pointer and a length.
pub(crate) struct Text {
    bytes: Vec<u8>,
    is_null: bool,
}

impl Text {
    pub(crate) fn pointer(&self) -> *const c_char {
        if self.is_null { null() } else { self.bytes.as_ptr().cast() }
    }

    pub(crate) fn length(&self) -> usize {
        self.bytes.len()
    }
}

/// Makes calls with random handles, texts and numbers.
pub(crate) struct Caller<'a> {
    pub(crate) random: Random,
    pool: &'a Pool,
    folder: &'a Path,
    /// Whether the call has no argument so far that the library has to refuse.
    is_sound: bool,
}

impl<'a> Caller<'a> {
    pub(crate) fn new(random: Random, pool: &'a Pool, folder: &'a Path) -> Self {
        Self { random, pool, folder, is_sound: true }
    }

    /// Makes a call, and checks how it ends.
    pub(crate) fn call(&mut self, operation: &Operation) -> texere_status {
        self.is_sound = true;
        let (name, status) = (operation.name, (operation.call)(self));
        let message = message();
        assert_ne!(status, TEXERE_PANIC, "{name}: {message}");
        assert!(status == TEXERE_OK || !message.is_empty(), "{name} says nothing");
        if operation.fails && !self.is_sound && !self.pool.is_shared {
            assert_eq!(status, TEXERE_ARGUMENT, "{name} took a wrong argument: {message}");
        }
        status
    }

    /// A handle of a kind: mostly a live one, and sometimes one that was freed, one of another
    /// kind, a number that is no handle, or null.
    pub(crate) fn handle<K: Kind>(&mut self) -> *mut K {
        let wrong = self.random.below(32);
        if wrong > 3 {
            return self.live();
        }
        self.is_sound = false;
        let garbage = self.random.next() as usize | 1 << 63;
        let other = (K::NUMBER + 1 + self.random.below(KINDS - 1)) % KINDS;
        let freed = || self.pool.freed.lock().unwrap().last().copied();
        without_provenance_mut(match wrong {
            0 => 0,
            1 => freed().unwrap_or(garbage),
            2 => self.pool.any(other, &mut self.random).unwrap_or(garbage),
            _ => garbage,
        })
    }

    /// A handle as `handle` gives it, or null, which is valid here.
    pub(crate) fn handle_or_null<K: Kind>(&mut self) -> *mut K {
        let (was_sound, handle) = (self.is_sound, self.handle::<K>());
        if handle.is_null() || self.random.one_in(2) {
            self.is_sound = was_sound;
            return null_mut();
        }
        handle
    }

    /// A live handle. If there is none, it is made.
    pub(crate) fn live<K: Kind>(&mut self) -> *mut K {
        if let Some(handle) = self.pool.any(K::NUMBER, &mut self.random) {
            return without_provenance_mut(handle);
        }
        let made = K::make(self);
        if made.is_null() {
            self.is_sound = false;
        } else {
            self.pool.add(K::NUMBER, made.addr());
        }
        made
    }

    /// Makes `call` with a pointer to which it writes a new handle, and keeps the handle. Sometimes
    /// the pointer is null.
    pub(crate) fn out<K: Kind>(&mut self, call: impl FnOnce(*mut *mut K) -> texere_status) -> texere_status {
        if self.random.one_in(40) {
            self.is_sound = false;
            return call(null_mut());
        }
        let mut handle: *mut K = without_provenance_mut(8);
        let status = call(&mut handle);
        assert_eq!(status == TEXERE_OK, !handle.is_null(), "a handle where the call failed, or none");
        if status == TEXERE_OK {
            self.pool.add(K::NUMBER, handle.addr());
        }
        status
    }

    /// Makes `call` with a pointer to a value, or sometimes with null.
    pub(crate) fn place<T>(&mut self, value: T, call: impl FnOnce(*mut T) -> texere_status) -> texere_status {
        let mut value = value;
        if self.random.one_in(40) {
            self.is_sound = false;
            return call(null_mut());
        }
        call(&mut value)
    }

    /// Frees a handle.
    pub(crate) fn free<K: Kind>(&mut self) -> texere_status {
        let handle: *mut K = self.handle();
        // The pool forgets the handle first. Otherwise another thread might draw it after it was
        // freed.
        self.pool.note_freed(K::NUMBER, handle.addr());
        free(K::NUMBER, handle.addr());
        TEXERE_OK
    }

    /// A struct of zeros with its size set, or sometimes with another size.
    pub(crate) fn sized<T>(&mut self) -> T {
        let mut size = size_of::<T>() as u32;
        if self.random.one_in(40) {
            self.is_sound = false;
            size = self.random.pick(&[0, size - 1, size + 1, u32::MAX]);
        }
        let mut value: T = sized();
        // SAFETY: the struct begins with a `u32`.
        unsafe { (&raw mut value).cast::<u32>().write(size) };
        value
    }

    /// One of `texts`, or sometimes a null pointer, or bytes that are no text.
    pub(crate) fn text(&mut self, texts: &[&str]) -> Text {
        let wrong = self.random.below(60);
        if wrong > 1 {
            return Text { bytes: self.random.pick(texts).into(), is_null: false };
        }
        self.is_sound = false;
        let bytes = if wrong == 0 { b"\xff\xfe.toml".to_vec() } else { vec![0; 4] };
        Text { bytes, is_null: wrong == 1 }
    }

    /// The path of one of the files `names` in the test's folder, or an invalid path.
    pub(crate) fn path(&mut self, names: &[&str]) -> Text {
        let mut text = self.text(names);
        if !text.is_null && text.bytes[0] != 0xff {
            let folder = if self.random.one_in(20) { Path::new("/no/such/folder") } else { self.folder };
            let path = folder.join(std::str::from_utf8(&text.bytes).unwrap());
            text.bytes = path.to_str().unwrap().into();
        }
        text
    }

    /// The number of values that a call needs, or sometimes another number, which the call has to
    /// refuse.
    pub(crate) fn count(&mut self, needed: u64) -> u64 {
        if self.random.one_in(20) {
            self.is_sound = false;
            return self.random.pick(&[needed + 1, needed.wrapping_sub(1), u64::MAX]);
        }
        needed
    }
}
