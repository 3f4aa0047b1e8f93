//! What shaders statically use, read off their SPIR-V.

use crate::buffers::{BufferName, BufferSet, BufferView};
use crate::gpu_interface::{SET_BUFFERS, SET_MATERIAL, SET_TARGETS};
use crate::{Error, Result};
use ash::vk;
use spirq::parse::{Instr, SpirvBinary};
use spirq::spirv::{Decoration, Op};
use std::collections::BTreeMap;

/// What the shaders of one pipeline use.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Uses {
    /// Buffers as they are viewed, with the stages that do.
    pub views: BTreeMap<(BufferName, BufferView), vk::ShaderStageFlags>,
    /// Buffers that are read, through any view.
    pub read: BufferSet,
    /// Buffers that are written.
    pub written: BufferSet,
    /// Whether anything of a material is.
    pub material: bool,
    /// Whether any image of a view's targets is.
    pub targets: bool,
}

impl Uses {
    /// What the shaders of some stages use, by their SPIR-V; `name` is for messages.
    ///
    /// # Errors
    /// [`Error::Internal`] where SPIR-V cannot be read, or binds what nobody declares.
    pub fn new(name: &str, stages: &[(vk::ShaderStageFlags, &[u32])]) -> Result<Self> {
        let mut uses = Self::default();
        for &(stage, words) in stages {
            let variables = variables(words).map_err(|e| fault(name, &format!("cannot be read: {e}")))?;
            for variable in variables.values().filter(|variable| variable.read || variable.written) {
                uses.add(stage, variable).map_err(|e| fault(name, &e))?;
            }
        }
        Ok(uses)
    }

    fn add(&mut self, stage: vk::ShaderStageFlags, variable: &Variable) -> Result<(), String> {
        match (variable.set, variable.binding) {
            (Some(SET_BUFFERS), Some(binding)) => {
                let (name, view) = BufferName::bound_at(binding)
                    .ok_or_else(|| format!("reads binding {binding}, which no buffer has"))?;
                *self.views.entry((name, view)).or_default() |= stage;
                if variable.read {
                    self.read.insert(name);
                }
                if variable.written {
                    self.written.insert(name);
                }
            }
            (Some(SET_MATERIAL), _) => self.material = true,
            (Some(SET_TARGETS), _) => self.targets = true,
            (Some(set), _) => return Err(format!("reads descriptor set {set}, which nobody binds")),
            // Inputs, outputs, shared memory and push constants.
            (None, _) => {}
        }
        Ok(())
    }

    /// The stages that use a buffer.
    pub fn stages(&self, name: BufferName) -> vk::ShaderStageFlags {
        let views = BufferView::ALL.into_iter().filter_map(|view| self.views.get(&(name, view)));
        views.fold(vk::ShaderStageFlags::empty(), |all, &stages| all | stages)
    }

    /// Refuses more storage buffers in a stage than the device binds.
    ///
    /// # Errors
    /// [`Error::Device`], with the name of the pipeline and of the device.
    pub fn check(&self, pipeline: &str, device: &str, most: u32) -> Result<()> {
        use vk::ShaderStageFlags as S;
        for stage in [S::COMPUTE, S::VERTEX, S::FRAGMENT] {
            let bound = |(&(_, view), stages): (&(_, BufferView), &S)| {
                view == BufferView::Storage && stages.contains(stage)
            };
            let needed = self.views.iter().filter(|&entry| bound(entry)).count();
            if needed > most as usize {
                return Err(Error::Device(format!(
                    "{device} binds {most} storage buffers per shader stage, {pipeline} needs {needed}: choose another \
                     device"
                )));
            }
        }
        Ok(())
    }
}

fn fault(name: &str, what: &str) -> Error {
    Error::Internal(format!("the SPIR-V of {name} {what}"))
}

/// A variable of a shader.
#[derive(Debug, Default)]
struct Variable {
    set: Option<u32>,
    binding: Option<u32>,
    read: bool,
    written: bool,
}

/// The variables with decorations or accesses, by their ids. The compiler leaves out functions that nothing calls, so that
/// every access counts.
fn variables(words: &[u32]) -> spirq::error::Result<BTreeMap<u32, Variable>> {
    let binary = SpirvBinary::from(words);
    let mut instructions = binary.instrs()?;
    let mut variables = BTreeMap::<u32, Variable>::new();
    let mut bases = BTreeMap::new();
    while let Some(instruction) = instructions.next()? {
        let operands = &instruction.as_ref()[1..];
        match (instruction.op(), operands) {
            (Op::Decorate, &[target, decoration, value, ..]) => {
                let variable = variables.entry(target).or_default();
                if decoration == Decoration::DescriptorSet as u32 {
                    variable.set = Some(value);
                } else if decoration == Decoration::Binding as u32 {
                    variable.binding = Some(value);
                }
            }
            (Op::AccessChain | Op::InBoundsAccessChain | Op::CopyObject, &[_, result, base, ..]) => {
                bases.insert(result, *bases.get(&base).unwrap_or(&base));
            }
            _ => {
                for (pointer, reads, writes) in accesses(instruction) {
                    let variable = variables.entry(*bases.get(&pointer).unwrap_or(&pointer)).or_default();
                    variable.read |= reads;
                    variable.written |= writes;
                }
            }
        }
    }
    Ok(variables)
}

/// What an instruction accesses: pointer, whether it is read, whether it is written.
fn accesses(instruction: &Instr) -> Vec<(u32, bool, bool)> {
    use Op as O;
    let operands = &instruction.as_ref()[1..];
    match (instruction.op(), operands) {
        (O::Load | O::AtomicLoad | O::ArrayLength, &[_, _, pointer, ..]) => vec![(pointer, true, false)],
        (O::Store | O::AtomicStore, &[pointer, ..]) => vec![(pointer, false, true)],
        (O::CopyMemory, &[target, source, ..]) => vec![(target, false, true), (source, true, false)],
        (
            O::AtomicExchange
            | O::AtomicCompareExchange
            | O::AtomicIIncrement
            | O::AtomicIDecrement
            | O::AtomicIAdd
            | O::AtomicISub
            | O::AtomicSMin
            | O::AtomicUMin
            | O::AtomicSMax
            | O::AtomicUMax
            | O::AtomicAnd
            | O::AtomicOr
            | O::AtomicXor,
            &[_, _, pointer, ..],
        ) => vec![(pointer, true, true)],
        // Textures are handed to functions.
        (O::FunctionCall, [_, _, _, arguments @ ..]) => {
            arguments.iter().map(|&argument| (argument, true, false)).collect()
        }
        _ => vec![],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffers::set;
    use crate::vk::ShaderLibrary;

    fn uses(body: &str) -> Uses {
        let include = format!("{}{}", crate::gpu_interface::glsl(), crate::buffers::glsl());
        let source = format!(
            "#version 460\n#include \"generated/gpu_interface.glsl\"\nlayout(local_size_x = 1) in;\n{body}"
        );
        let generated = vec![("generated/gpu_interface.glsl".into(), include), ("probe.comp".into(), source)];
        let library = ShaderLibrary::new(None, generated).unwrap().with_cache(None);
        let words = library.compile("probe.comp", &[]).unwrap();
        Uses::new("probe.comp", &[(vk::ShaderStageFlags::COMPUTE, &words)]).unwrap()
    }

    #[test]
    fn reads_and_writes_are_told_apart_whatever_the_view() {
        use BufferName as B;
        let found = uses(
            "void unused() { word_ranks[0] = 1u; }\n\
             void main() { list_offsets[state.visible] = read_index(3u) + visible_clusters[0];\n\
             atomicOr(cluster_bits[1], 1u); new_state.masked = 1u; light_nodes[1].radius = read_light(2u).r1; }",
        );
        assert_eq!(
            found.read,
            set(&[B::State, B::LightIndices, B::VisibleClusters, B::ClusterBits, B::Lights])
        );
        assert_eq!(found.written, set(&[B::ListOffsets, B::ClusterBits, B::State, B::LightNodes]));
        assert_eq!(found.views.len(), 8);
        assert!(found.views.contains_key(&(B::State, BufferView::Uniform)));
        assert!(!found.views.contains_key(&(B::LightIndices, BufferView::Storage)));
        assert!(!found.material && !found.targets);
    }

    #[test]
    fn a_device_that_binds_too_few_storage_buffers_is_refused_with_the_pipeline() {
        let found = uses("void main() { list_offsets[state.visible] = word_ranks[0] + read_index(3u); }");
        found.check("probe.comp", "the device", 2).unwrap();
        let refusal = found.check("probe.comp", "the device", 1).unwrap_err().to_string();
        assert!(refusal.contains("the device binds 1 storage buffers per shader stage, probe.comp needs 2"));
    }
}
