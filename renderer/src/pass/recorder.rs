//! The recorder: labels, timestamp scopes and barriers of one frame's commands.

use super::access::{Access, Tracker};
use super::scope_tree::{ScopeId, ScopeName, ScopeTree};
use crate::vk::Context;
use ash::vk;
use std::cell::Cell;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Which scopes get timestamps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Timed {
    /// The outermost alone: the frame.
    Frame,
    /// Every stage.
    Stages,
    /// Every stage, and every compute pass as a stage of its own.
    Passes,
}

/// Timestamp queries of one frame in flight. Scopes that begin or end with no command between share one.
pub struct Timestamps {
    context: Arc<Context>,
    pool: vk::QueryPool,
    values: Vec<u64>,
    /// Where each timed scope of the last frame recorded finds its begin and its end among the values.
    places: Vec<[usize; 2]>,
    /// Queries written in that frame.
    written: usize,
    /// The scopes of that frame, in execution order, parents first.
    scopes: Vec<ScopeId>,
    /// When recording of each of them began, and how long it took.
    cpu: Vec<(Instant, Duration)>,
}

/// How long one scope took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScopeTime {
    /// Which scope it was.
    pub scope: ScopeId,
    /// Milliseconds on the device; NaN without timestamps.
    pub gpu_ms: f64,
    /// Milliseconds that recording it took.
    pub cpu_ms: f64,
}

/// When one scope ran.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScopeSpan {
    /// Which scope it was.
    pub scope: ScopeId,
    /// Start and end in ticks of the device's clock; `None` without timestamps.
    pub gpu_ticks: Option<[u64; 2]>,
    /// Time on the host when the recording of the scope began.
    pub cpu_start: Instant,
    /// How long its recording took.
    pub cpu_time: Duration,
}

/// More scopes than any method's stage tree has for `views` views, each pass counted.
const fn most_scopes(views: usize) -> usize {
    32 + 96 * views
}

impl Timestamps {
    /// Queries for one frame in flight with `views` views.
    pub fn new(context: &Arc<Context>, views: usize) -> crate::Result<Self> {
        let scopes = most_scopes(views);
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::TIMESTAMP)
            .query_count(2 * scopes as u32);
        let pool = unsafe { context.device.create_query_pool(&info, None) }
            .map_err(|e| crate::Error::Device(format!("cannot create timestamp queries: {e}")))?;
        context.name(pool, "timestamps");
        Ok(Self {
            context: context.clone(),
            pool,
            values: vec![0; 2 * scopes],
            places: Vec::with_capacity(scopes),
            written: 0,
            scopes: Vec::with_capacity(scopes),
            cpu: Vec::with_capacity(scopes),
        })
    }

    /// How long each scope of the last frame took, in execution order. Its frame must have ended, so that nothing is
    /// waited for.
    pub fn read(&mut self) -> crate::Result<impl ExactSizeIterator<Item = ScopeTime> + '_> {
        let values = &mut self.values[..self.written];
        if !values.is_empty() {
            let flags = vk::QueryResultFlags::TYPE_64;
            unsafe { self.context.device.get_query_pool_results(self.pool, 0, values, flags) }.map_err(
                |e| crate::Error::Internal(format!("timestamps of an ended frame are missing: {e}")),
            )?;
        }
        let limits = &self.context.limits;
        let mask = u64::MAX >> (64 - limits.timestamp_valid_bits.clamp(1, 64));
        let period = limits.timestamp_period_ns;
        Ok(self.spans().map(move |span| {
            let milliseconds =
                |[start, end]: [u64; 2]| (end.wrapping_sub(start) & mask) as f64 * period * 1e-6;
            ScopeTime {
                scope: span.scope,
                gpu_ms: span.gpu_ticks.map_or(f64::NAN, milliseconds),
                cpu_ms: span.cpu_time.as_secs_f64() * 1e3,
            }
        }))
    }

    /// When each scope ran of the frame that [`Self::read`] read last, in execution order.
    pub fn spans(&self) -> impl ExactSizeIterator<Item = ScopeSpan> + '_ {
        let scopes = self.scopes.iter().zip(&self.cpu).enumerate();
        scopes.map(|(position, (&scope, &(cpu_start, cpu_time)))| {
            let gpu_ticks = self.places.get(position).map(|ends| ends.map(|query| self.values[query]));
            ScopeSpan { scope, gpu_ticks, cpu_start, cpu_time }
        })
    }
}

impl Drop for Timestamps {
    fn drop(&mut self) {
        unsafe { self.context.device.destroy_query_pool(self.pool, None) };
    }
}

/// Records one frame: every pass gets its label, its timestamp scope and its barriers here.
pub struct Recorder<'a> {
    /// The device, for drawing the scene; all other passes have a call of their own.
    pub context: &'a Context,
    commands: vk::CommandBuffer,
    /// Whether commands may have been recorded since the last timestamp.
    stirred: Cell<bool>,
    tree: &'a mut ScopeTree,
    timestamps: &'a mut Timestamps,
    tracker: &'a mut FrameTracker,
    timed: Timed,
    current: Option<ScopeId>,
    /// What the host did for the frame before it was recorded, as far as it is told: the recorder's clock is ahead by that.
    before: Duration,
}

/// Keeps the barrier tracker's memory from frame to frame.
#[derive(Debug, Default)]
pub struct FrameTracker {
    tracker: Tracker,
    /// What is left out of the frames; nothing, but where the self-test is tested.
    pub faults: Faults,
}

/// Synchronisation that recorders leave out, so that tests of the self-test see it notice.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Faults {
    /// Whether nothing waits behind a timestamp.
    pub loose_timestamps: bool,
    /// Whether passes wait for nothing.
    pub unsynchronised_passes: bool,
}

impl<'a> Recorder<'a> {
    /// Starts a frame on an open command buffer.
    pub fn new(
        context: &'a Context,
        commands: vk::CommandBuffer,
        tree: &'a mut ScopeTree,
        timestamps: &'a mut Timestamps,
        tracker: &'a mut FrameTracker,
        timed: Timed,
    ) -> Self {
        tracker.tracker.begin_frame();
        timestamps.places.clear();
        timestamps.written = 0;
        timestamps.scopes.clear();
        timestamps.cpu.clear();
        let queries = timestamps.values.len() as u32;
        unsafe { context.device.cmd_reset_query_pool(commands, timestamps.pool, 0, queries) };
        let recorder = Self {
            context,
            commands,
            stirred: Cell::new(true),
            tree,
            timestamps,
            tracker,
            timed,
            current: None,
            before: Duration::ZERO,
        };
        recorder.full_barrier();
        recorder
    }

    /// The frame's command buffer, to record to; for drawing the scene alone.
    pub fn commands(&self) -> vk::CommandBuffer {
        self.stirred.set(true);
        self.commands
    }

    /// Runs `body` as a stage: labelled, timed, child of the stage that is open.
    pub fn scope<'n, R>(&mut self, name: impl Into<ScopeName<'n>>, body: impl FnOnce(&mut Self) -> R) -> R {
        let position = self.timestamps.scopes.len();
        assert!(2 * position < self.timestamps.values.len(), "a frame has more stages than queries");
        let scope = self.tree.enter(name.into(), self.current, self.timestamps.scopes.last().copied());
        self.timestamps.scopes.push(scope);
        let outer = self.current.replace(scope);
        let timed = self.timed != Timed::Frame || position == 0;
        self.context.begin_label(self.commands, self.tree.label(scope));
        if timed {
            let begin = self.timestamp();
            self.timestamps.places.push([begin; 2]);
        }
        let start = self.now();
        self.timestamps.cpu.push((start, Duration::ZERO));
        let result = body(self);
        self.timestamps.cpu[position].1 = self.now() - start;
        if timed {
            self.timestamps.places[position][1] = self.timestamp();
        }
        self.context.end_label(self.commands);
        self.current = outer;
        result
    }

    /// A stage without commands that the host took `seconds` for before the frame was recorded: told as if it had been now, so that
    /// it lies in the stages that are open, and they last as much longer.
    pub fn host_step(&mut self, name: &str, seconds: f64) {
        let position = self.timestamps.scopes.len();
        let took = Duration::from_secs_f64(seconds.max(0.0));
        self.scope(name, |r| r.before += took);
        // What telling it took is not the step's.
        self.timestamps.cpu[position].1 = took;
    }

    fn now(&self) -> Instant {
        Instant::now() + self.before
    }

    /// Runs `body` as a pass: a stage of its own where passes are timed. A stage's passes by one name are numbered.
    pub(super) fn pass(&mut self, name: &str, body: impl FnOnce(&mut Self)) {
        if self.timed != Timed::Passes {
            return body(self);
        }
        let number = self.tree.count(&self.timestamps.scopes, name, self.current);
        self.scope((name, number), body);
    }

    /// Waits for what `accesses` need; the commands that follow may then do what they say.
    pub fn access(&mut self, accesses: impl IntoIterator<Item = Access>) {
        let commands = self.commands();
        if !self.tracker.faults.unsynchronised_passes {
            self.tracker.tracker.synchronise(&self.context.device, commands, accesses);
        }
    }

    /// A timestamp that is right on every driver: lavapipe defers it into the work at hand unless a barrier
    /// of all commands follows. The last one, where nothing was recorded since: each costs the device that barrier.
    fn timestamp(&mut self) -> usize {
        if !self.stirred.replace(false) {
            return self.timestamps.written - 1;
        }
        let query = self.timestamps.written;
        self.timestamps.written += 1;
        let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
        unsafe {
            self.context.device.cmd_write_timestamp2(
                self.commands,
                stage,
                self.timestamps.pool,
                query as u32,
            );
        }
        if !self.tracker.faults.loose_timestamps {
            self.wait_for_all();
        }
        query
    }

    /// What follows starts once all that was recorded has ended, and sees all that it wrote.
    fn full_barrier(&self) {
        use vk::AccessFlags2 as A;
        self.barrier(A::MEMORY_WRITE, A::MEMORY_READ | A::MEMORY_WRITE);
    }

    /// What follows starts once all that was recorded has ended. No memory is made visible: passes ask for that
    /// themselves, and emptying caches for a timestamp would be a cost of measuring.
    fn wait_for_all(&self) {
        self.barrier(vk::AccessFlags2::NONE, vk::AccessFlags2::NONE);
    }

    fn barrier(&self, written: vk::AccessFlags2, seen: vk::AccessFlags2) {
        let barrier = vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(written)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .dst_access_mask(seen);
        let barriers = [barrier];
        let dependency = vk::DependencyInfo::default().memory_barriers(&barriers);
        unsafe { self.context.device.cmd_pipeline_barrier2(self.commands, &dependency) };
    }
}
