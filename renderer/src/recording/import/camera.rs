//! The camera of the thesis's program: keys move it, the mouse turns it, and it follows smoothly.

use super::super::Frame;
use super::decode::{Camera, Event};
use glam::DVec3;
use std::collections::BTreeSet;
use std::f32::consts::FRAC_PI_2;

/// How much of the way to its target the camera goes in a frame.
const SMOOTHING: f32 = 0.2;

/// How many times faster the camera moves with the left shift key down, less 1.
const SPRINT: f32 = 3.0;

/// Virtual key codes, in the order of winit 0.19.
mod key {
    pub(super) const A: u32 = 10;
    pub(super) const D: u32 = 13;
    pub(super) const Q: u32 = 26;
    pub(super) const S: u32 = 28;
    pub(super) const W: u32 = 32;
    pub(super) const Z: u32 = 35;
    pub(super) const LEFT_SHIFT: u32 = 112;
}

/// Where the camera is, or shall be: metres and radians. Yaw counts its turns on, which no rotation shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CameraState {
    position: [f32; 3],
    yaw: f32,
    pitch: f32,
    fov: f32,
}

/// The camera's state between frames. In single precision, as the program had it: the error of a replay stays
/// near 1e-5 m instead of 1e-4 m.
pub(super) struct Simulation {
    positional_velocity: f32,
    angular_velocity: f32,
    dt: f32,
    focused: bool,
    pressed: BTreeSet<u32>,
    target: CameraState,
    current: CameraState,
}

impl Simulation {
    /// A camera at rest at its stored pose; `dt` is the time of a frame in seconds.
    pub(super) fn new(camera: &Camera, dt: f32) -> Self {
        let Camera { positional_velocity, angular_velocity, position, yaw, pitch, fov, .. } = *camera;
        let state = CameraState { position, yaw, pitch, fov };
        Self {
            positional_velocity,
            angular_velocity,
            dt,
            focused: false,
            pressed: BTreeSet::new(),
            target: state,
            current: state,
        }
    }

    /// Takes one frame's events in and returns the camera that the frame was drawn with.
    pub(super) fn step(&mut self, events: &[Event]) -> CameraState {
        let turn = self.take_in(events);
        if self.focused {
            self.move_target();
            self.turn_target(turn);
        }
        self.current.follow(&self.target);
        self.current
    }

    /// Updates focus and keys; returns the mouse's motion to the right and down.
    fn take_in(&mut self, events: &[Event]) -> [f64; 2] {
        let mut motion = [0.0; 2];
        for event in events {
            match *event {
                Event::Focused(focused) => self.focused = focused,
                Event::Key { code, pressed: true } => drop(self.pressed.insert(code)),
                Event::Key { code, pressed: false } => drop(self.pressed.remove(&code)),
                Event::Mouse { axis: axis @ (0 | 1), value } => motion[axis as usize] += value,
                Event::Mouse { .. } | Event::Other => {}
            }
        }
        motion
    }

    /// Moves along the axes of the yawed camera; the yaw is that of before this frame's turn.
    fn move_target(&mut self) {
        let down = |code| f32::from(u8::from(self.pressed.contains(&code)));
        let sprint = 1.0 + SPRINT * down(key::LEFT_SHIFT);
        let axes = [down(key::D) - down(key::A), down(key::Q) - down(key::Z), down(key::S) - down(key::W)];
        let [right, up, back] = axes.map(|axis| axis * sprint * self.positional_velocity * self.dt);
        // In double precision and rounded, so that all platforms' sines agree.
        let (sin, cos) = f64::from(self.target.yaw).sin_cos();
        let (sin, cos) = (sin as f32, cos as f32);
        let [x, y, z] = &mut self.target.position;
        *x += cos * right + sin * back;
        *y += up;
        *z += cos * back - sin * right;
    }

    fn turn_target(&mut self, [right, down]: [f64; 2]) {
        self.target.yaw -= right as f32 * self.angular_velocity * self.dt;
        let pitch = self.target.pitch - down as f32 * self.angular_velocity * self.dt;
        self.target.pitch = pitch.clamp(-FRAC_PI_2, FRAC_PI_2);
    }
}

impl CameraState {
    fn follow(&mut self, target: &Self) {
        let approach = |from: &mut f32, to: f32| *from += (to - *from) * SMOOTHING;
        for (from, to) in self.position.iter_mut().zip(target.position) {
            approach(from, to);
        }
        approach(&mut self.yaw, target.yaw);
        approach(&mut self.pitch, target.pitch);
        approach(&mut self.fov, target.fov);
    }
}

impl From<CameraState> for Frame {
    fn from(state: CameraState) -> Self {
        let [yaw, pitch, fov] = [state.yaw, state.pitch, state.fov].map(f64::from);
        Self::from_angles(DVec3::from(state.position.map(f64::from)), yaw, pitch, fov)
    }
}
