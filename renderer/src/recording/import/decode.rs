//! The layout of the thesis's `.bin` recordings, little-endian: two cameras (main, debug), then to the end of
//! the file one counted list of events per frame.

/// Smallest event: the kinds of an event and of a window event.
const MIN_EVENT_BYTES: usize = 8;

/// A camera's settings and pose, as the program stored them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Camera {
    /// Z of the far plane: -far, metres.
    pub(super) z_far: f32,
    /// Z of the near plane: -near, metres.
    pub(super) z_near: f32,
    /// Speed of the camera, m/s.
    pub(super) positional_velocity: f32,
    /// Radians per second and unit of mouse motion.
    pub(super) angular_velocity: f32,
    /// Place of the camera in the world, metres.
    pub(super) position: [f32; 3],
    /// Turn about +Y, radians.
    pub(super) yaw: f32,
    /// About the turned +X, radians.
    pub(super) pitch: f32,
    /// Along the longer axis, radians.
    pub(super) fov: f32,
}

/// What the camera needs to know of one event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Event {
    /// The window gained or lost the focus.
    Focused(bool),
    /// A key with a virtual key code went down or up.
    Key { code: u32, pressed: bool },
    /// The mouse moved along axis 0 (right) or 1 (down).
    Mouse { axis: u32, value: f64 },
    /// Nothing that moves the camera.
    Other,
}

/// A decoded recording.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Decoded {
    /// The main camera; the debug camera is not kept.
    pub(super) camera: Camera,
    /// Events of each frame.
    pub(super) frames: Vec<Vec<Event>>,
}

/// Decodes a whole file. The error says at which byte it stops being a recording.
pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, String> {
    let mut reader = Reader { bytes, at: 0 };
    let camera = reader.camera()?;
    reader.camera()?;
    let mut frames = Vec::new();
    while reader.at < bytes.len() {
        frames.push(reader.events().map_err(|error| format!("frame {}: {error}", frames.len()))?);
    }
    if frames.is_empty() {
        return Err("ends after its cameras, without a frame".to_owned());
    }
    Ok(Decoded { camera, frames })
}

struct Reader<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let rest = &self.bytes[self.at..];
        let Some(taken) = rest.first_chunk::<N>() else {
            return Err(format!("is cut short: ends at byte {}, within a value", self.bytes.len()));
        };
        self.at += N;
        Ok(*taken)
    }

    /// An error about the `width` bytes just read.
    fn foreign(&self, width: usize, what: String) -> String {
        format!("is no recording of the thesis's program: at byte {}, {what}", self.at - width)
    }

    fn u32(&mut self) -> Result<u32, String> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    fn f32(&mut self) -> Result<f32, String> {
        let value = f32::from_le_bytes(self.take()?);
        if value.is_finite() { Ok(value) } else { Err(self.foreign(4, format!("{value}"))) }
    }

    fn f64(&mut self) -> Result<f64, String> {
        let value = f64::from_le_bytes(self.take()?);
        if value.is_finite() { Ok(value) } else { Err(self.foreign(8, format!("{value}"))) }
    }

    fn flag(&mut self) -> Result<bool, String> {
        match self.take::<1>()? {
            [0] => Ok(false),
            [1] => Ok(true),
            [other] => Err(self.foreign(1, format!("a flag of {other}"))),
        }
    }

    fn camera(&mut self) -> Result<Camera, String> {
        let mut values = [0.0; 11];
        for value in &mut values {
            *value = self.f32()?;
        }
        let [z_far, z_near, positional_velocity, angular_velocity, _zoom, x, y, z, yaw, pitch, fov] = values;
        if !(z_far < z_near && z_near < 0.0) {
            return Err(self.foreign(44, format!("a camera with depths {z_far} and {z_near}")));
        }
        if !(fov > 0.0 && fov < std::f32::consts::PI) {
            return Err(self.foreign(4, format!("a field of view of {fov}")));
        }
        let position = [x, y, z];
        Ok(Camera { z_far, z_near, positional_velocity, angular_velocity, position, yaw, pitch, fov })
    }

    fn events(&mut self) -> Result<Vec<Event>, String> {
        let count = u64::from_le_bytes(self.take()?);
        let room = (self.bytes.len() - self.at) / MIN_EVENT_BYTES;
        if count > room as u64 {
            return Err(self.foreign(8, format!("{count} events, where the file has room for {room}")));
        }
        (0..count).map(|_| self.event()).collect()
    }

    fn event(&mut self) -> Result<Event, String> {
        match self.u32()? {
            0 => self.window_event(),
            1 => self.key_event(),
            2 => Ok(Event::Mouse { axis: self.u32()?, value: self.f64()? }),
            kind => Err(self.foreign(4, format!("an event of kind {kind}"))),
        }
    }

    fn window_event(&mut self) -> Result<Event, String> {
        match self.u32()? {
            0 => {}
            1 => drop(self.f64()?),
            2 => return Ok(Event::Focused(self.flag()?)),
            3 => drop((self.f64()?, self.f64()?)),
            kind => return Err(self.foreign(4, format!("a window event of kind {kind}"))),
        }
        Ok(Event::Other)
    }

    fn key_event(&mut self) -> Result<Event, String> {
        let _scancode = self.u32()?;
        let pressed = match self.u32()? {
            0 => true,
            1 => false,
            state => return Err(self.foreign(4, format!("a key in state {state}"))),
        };
        let code = if self.flag()? { Some(self.u32()?) } else { None };
        for _modifier in 0..4 {
            self.flag()?;
        }
        Ok(code.map_or(Event::Other, |code| Event::Key { code, pressed }))
    }
}
