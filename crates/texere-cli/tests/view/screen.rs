//! A virtual screen, with a pointer that the test moves and keys that it presses.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    ClientMessageEvent, ConfigureWindowAux, ConnectionExt as _, EventMask, ImageFormat, InputFocus, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// The longest time that a test waits for anything.
pub(crate) const DEADLINE: Duration = Duration::from_secs(120);

/// Kinds of events, as X11 numbers them.
const KEY_PRESS: u8 = 2;
const KEY_RELEASE: u8 = 3;
const BUTTON_PRESS: u8 = 4;
const BUTTON_RELEASE: u8 = 5;
const MOTION: u8 = 6;

/// An X server that draws into memory.
pub(crate) struct Screen {
    server: Child,
    pub(crate) name: String,
    connection: RustConnection,
    root: Window,
}

impl Screen {
    pub(crate) fn open() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb; on Debian and Ubuntu install xvfb");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let name = format!(":{}", number.trim());
        let (connection, screen) = x11rb::connect(Some(&name)).unwrap();
        let root = connection.setup().roots[screen].root;
        Self { server, name, connection, root }
    }

    /// Waits for the program's window, gives it the keyboard, and returns it.
    pub(crate) fn window(&self) -> Window {
        let window = wait_for("a window", || {
            let all = self.connection.query_tree(self.root).unwrap().reply().unwrap().children;
            all.into_iter().find(|&window| {
                let shape = self.connection.get_geometry(window).unwrap().reply();
                let shown = self.connection.get_window_attributes(window).unwrap().reply();
                shape.is_ok_and(|shape| shape.width > 100)
                    && shown.is_ok_and(|shown| u8::from(shown.map_state) == 2)
            })
        });
        self.connection.set_input_focus(InputFocus::POINTER_ROOT, window, x11rb::CURRENT_TIME).unwrap();
        self.connection.flush().unwrap();
        window
    }

    pub(crate) fn point_at(&self, [x, y]: [u32; 2]) {
        self.fake(MOTION, 0, [x as i16, y as i16]);
    }

    pub(crate) fn button(&self, is_down: bool) {
        self.fake(if is_down { BUTTON_PRESS } else { BUTTON_RELEASE }, 1, [0, 0]);
    }

    /// Presses keys and releases them. `keys` are their symbols in Latin 1, or X11's numbers.
    pub(crate) fn press(&self, keys: &[u32]) {
        let setup = self.connection.setup();
        let (first, last) = (setup.min_keycode, setup.max_keycode);
        let map = self.connection.get_keyboard_mapping(first, last - first + 1).unwrap().reply().unwrap();
        let columns = map.keysyms_per_keycode as usize;
        let code = |symbol: &u32| {
            let row = map.keysyms.chunks(columns).position(|row| row.first() == Some(symbol)).unwrap();
            first + row as u8
        };
        let codes: Vec<u8> = keys.iter().map(code).collect();
        codes.iter().for_each(|&code| self.fake(KEY_PRESS, code, [0, 0]));
        codes.iter().rev().for_each(|&code| self.fake(KEY_RELEASE, code, [0, 0]));
    }

    fn fake(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) {
        self.connection.xtest_fake_input(kind, detail, 0, self.root, x, y, 0).unwrap().check().unwrap();
        // Events come no faster than from a hand.
        sleep(Duration::from_millis(20));
    }

    /// Gives a window another size.
    pub(crate) fn resize(&self, window: Window, [width, height]: [u32; 2]) {
        let size = ConfigureWindowAux::new().width(width).height(height);
        self.connection.configure_window(window, &size).unwrap().check().unwrap();
    }

    /// Asks a window to close, as a click on its cross does.
    pub(crate) fn close(&self, window: Window) {
        let atom = |name: &[u8]| self.connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
        let data = [atom(b"WM_DELETE_WINDOW"), 0, 0, 0, 0];
        let event = ClientMessageEvent::new(32, window, atom(b"WM_PROTOCOLS"), data);
        self.connection.send_event(false, window, EventMask::NO_EVENT, event).unwrap().check().unwrap();
    }

    /// Waits until `is_meant` accepts the screen's picture, and returns it.
    pub(crate) fn picture(&self, what: &str, is_meant: impl Fn(&Picture) -> bool) -> Picture {
        wait_for(what, || Some(self.grab()).filter(&is_meant))
    }

    fn grab(&self) -> Picture {
        let (all, format) = (self.connection.get_geometry(self.root).unwrap(), ImageFormat::Z_PIXMAP);
        let all = all.reply().unwrap();
        let image = self.connection.get_image(format, self.root, 0, 0, all.width, all.height, !0).unwrap();
        let bytes = image.reply().unwrap().data;
        let pixels = bytes.chunks_exact(4).map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect();
        Picture { width: all.width.into(), pixels }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// A picture of a screen: red, green and blue of each pixel.
pub(crate) struct Picture {
    width: u32,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    pub(crate) fn at(&self, [x, y]: [u32; 2]) -> [u8; 3] {
        self.pixels[(y * self.width + x) as usize]
    }

    /// The mean difference of two pictures right of `left`, in levels of 255. Different numbers of
    /// samples a pixel, which depend on how busy the machine is, make one or two levels.
    pub(crate) fn off(&self, other: &Self, left: u32) -> f32 {
        let channels = self.places(left).flat_map(|at| (0..3).map(move |channel| (at, channel)));
        let (sum, count) = channels.fold((0, 0), |(sum, count), (at, channel)| {
            (sum + u64::from(self.at(at)[channel].abs_diff(other.at(at)[channel])), count + 1)
        });
        sum as f32 / count as f32
    }

    /// All places right of `left`.
    pub(crate) fn places(&self, left: u32) -> impl Iterator<Item = [u32; 2]> + use<> {
        let (width, height) = (self.width, self.pixels.len() as u32 / self.width);
        (0..height).flat_map(move |y| (left..width).map(move |x| [x, y]))
    }
}

/// Waits until `look` finds something, and returns it.
pub(crate) fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(start.elapsed() < DEADLINE, "{what} did not come");
        sleep(Duration::from_millis(100));
    }
}
