//! What a pass says of the buffers it touches, and whether its shaders agree.

use super::{Access, Recorder, Use};
use crate::buffers::{BufferName, BufferSet, set};
use crate::layouts::{BoundBuffers, Pipeline};
use ash::vk;

/// The buffers that a pass touches in the frame, but for those that stay as they are.
#[derive(Debug, Clone, Copy, Default)]
pub struct Declared {
    /// Buffers that are read alone.
    pub reads: BufferSet,
    /// Buffers that are written, and perhaps read.
    pub writes: BufferSet,
}

impl Declared {
    /// The first difference from what pipelines use, if there is one.
    fn fault<'a>(
        &self,
        pipelines: impl IntoIterator<Item = &'a Pipeline> + Clone,
        empty: BufferSet,
    ) -> Option<String> {
        let merged = |part: fn(&Pipeline) -> BufferSet| {
            pipelines.clone().into_iter().fold(BufferSet::EMPTY, |all, pipeline| all | part(pipeline))
        };
        // Of a kind of surface that the scene lacks there are none.
        pipelines.clone().into_iter().next()?;
        let read = merged(|pipeline| pipeline.uses().read);
        let written = merged(|pipeline| pipeline.uses().written);
        let difference = self.difference(read, written, empty)?;
        let names: Vec<_> = pipelines.into_iter().map(|pipeline| pipeline.name.as_str()).collect();
        Some(format!("{}: buffer {difference}", names.join(", ")))
    }

    /// The first buffer that is used otherwise than declared, and how. Those that are empty or constant are nobody's
    /// concern.
    fn difference(&self, read: BufferSet, written: BufferSet, empty: BufferSet) -> Option<String> {
        let constant = BufferName::ALL.into_iter().filter(|name| name.info().is_constant());
        let ignored = constant.fold(empty, |all, name| all | set(&[name]));
        let compared = [
            ("written but not declared to be", written, self.writes),
            ("read but not declared to be", read - written, self.reads),
            ("declared to be written but is not", self.writes, written),
            ("declared to be read but is not", self.reads, read - written),
        ];
        compared.into_iter().find_map(|(what, one, other)| {
            let buffer = (one - other - ignored).names().next()?;
            Some(format!("{} is {what}", buffer.info().name))
        })
    }
}

impl Recorder<'_> {
    /// Whether what passes say is compared with what their pipelines do: in debug builds, and where devices validate.
    pub fn checks(&self) -> bool {
        cfg!(debug_assertions) || self.context.validates()
    }

    /// Waits for what pipelines use of `buffers`, and for `others`.
    ///
    /// # Panics
    /// Where builds or devices check and the shaders use buffers otherwise than declared: a fault of the program.
    pub fn prepare<'a>(
        &mut self,
        pipelines: impl IntoIterator<Item = &'a Pipeline> + Clone,
        buffers: &BoundBuffers,
        declared: Declared,
        others: impl IntoIterator<Item = Option<Access>>,
    ) {
        if self.checks()
            && let Some(fault) = declared.fault(pipelines.clone(), buffers.empty)
        {
            panic!("{fault}");
        }
        let stages = |name: BufferName| {
            let each = pipelines.clone().into_iter().map(|pipeline| pipeline.uses().stages(name));
            each.fold(vk::ShaderStageFlags::empty(), |all, stages| all | stages)
        };
        let of = |set: BufferSet, uses: [Use; 3]| {
            (set - buffers.empty).names().flat_map(move |name| {
                let stages = stages(name);
                let handle = buffers.handles[name as usize];
                let [compute, vertex, fragment] = uses;
                [
                    (vk::ShaderStageFlags::COMPUTE, compute),
                    (vk::ShaderStageFlags::VERTEX, vertex),
                    (vk::ShaderStageFlags::FRAGMENT, fragment),
                ]
                .into_iter()
                .filter(move |(stage, _)| stages.contains(*stage))
                .map(move |(_, usage)| Access::buffer(handle, usage))
            })
        };
        let reads = of(declared.reads, [Use::ComputeRead, Use::VertexRead, Use::FragmentRead]);
        let writes = of(declared.writes, [Use::ComputeWrite, Use::FragmentWrite, Use::FragmentWrite]);
        self.access(others.into_iter().flatten().chain(reads).chain(writes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffers::BufferName as B;

    fn fault(reads: &[B], writes: &[B], empty: &[B]) -> Option<String> {
        let used = (set(&[B::State, B::VisibleClusters, B::Views]), set(&[B::LightMasks, B::Counters]));
        let declared = Declared { reads: set(reads), writes: set(writes) };
        declared.difference(used.0, used.1, set(empty))
    }

    #[test]
    fn a_buffer_that_is_not_declared_is_noticed_by_name() {
        let all = [B::State, B::VisibleClusters];
        let writes = [B::LightMasks, B::Counters];
        assert_eq!(fault(&all, &writes, &[]), None);
        let missing_read = fault(&all[1..], &writes, &[]).unwrap();
        assert_eq!(missing_read, "state is read but not declared to be");
        let missing_write = fault(&all, &writes[1..], &[]).unwrap();
        assert_eq!(missing_write, "light_masks is written but not declared to be");
        // Reading is not enough where a shader writes.
        let [state, visible] = all;
        assert!(
            fault(&[state, visible, B::LightMasks], &writes[1..], &[]).unwrap().contains("is written but")
        );
    }

    #[test]
    fn a_buffer_that_is_declared_in_vain_is_noticed_unless_it_is_empty() {
        let reads = [B::State, B::VisibleClusters, B::Groups];
        let writes = [B::LightMasks, B::Counters];
        assert_eq!(fault(&reads, &writes, &[]).unwrap(), "groups is declared to be read but is not");
        assert_eq!(fault(&reads, &writes, &[B::Groups]), None);
        assert_eq!(fault(&reads[..2], &writes[..1], &[B::Counters]), None);
    }
}
