//! Vertex attributes of a primitive, its morph targets added (glTF 2.0, sections 3.7.2.1 and 3.7.2.2).

use std::ops::Range;

use glam::{Vec3, Vec4};
use gltf::json;
use json::mesh::{MorphTarget, Semantic};
use json::validation::Checked;

use super::super::mesh::Mesh;
use super::accessor::Accessor;
use super::document::Document;
use super::material::TexCoords;
use super::skin::Influences;

/// A primitive whose attributes are read.
#[derive(Clone, Copy)]
pub(super) struct Attributes<'a> {
    pub document: &'a Document,
    pub json: &'a json::mesh::Primitive,
    /// Weights of the morph targets, by their order.
    pub weights: &'a [f32],
}

/// The vertices read, of all that there are.
#[derive(Clone)]
pub(super) struct Wanted {
    /// Number of elements that each attribute has.
    pub count: usize,
    /// Vertices in use.
    pub range: Range<usize>,
}

impl<'a> Attributes<'a> {
    /// An attribute as it lies in the file, if the primitive has it.
    pub fn find(&self, semantic: Semantic) -> Result<Option<Accessor<'a>>, String> {
        let name = semantic.to_string();
        let index = self.json.attributes.get(&Checked::Valid(semantic));
        let accessor = index.map(|&index| Accessor::new(self.document, index)).transpose();
        accessor.map_err(|message| format!("{name}: {message}"))
    }

    /// An attribute of `lanes` components for each vertex.
    fn expect(
        &self,
        semantic: Semantic,
        wanted: &Wanted,
        lanes: usize,
    ) -> Result<Option<Accessor<'a>>, String> {
        let accessor = self.find(semantic)?;
        if let Some(accessor) = &accessor {
            accessor.expect_lanes(lanes)?;
            accessor.expect_count(wanted.count)?;
        }
        Ok(accessor)
    }

    /// Reads positions.
    pub fn read_positions(
        &self,
        positions: &Accessor,
        wanted: &Wanted,
        mesh: &mut Mesh,
    ) -> Result<(), String> {
        positions.expect_lanes(3)?;
        positions.floats(wanted.range.clone(), |i, position| mesh.vertices[i].position = position);
        let deltas = self.morphed(
            wanted,
            |target| target.positions,
            |accessor, range, put| accessor.floats(range, put),
        )?;
        for (vertex, delta) in mesh.vertices.iter_mut().zip(deltas) {
            vertex.position = (Vec3::from(vertex.position) + delta).to_array();
        }
        match mesh.first_bad_position() {
            Some(vertex) => Err(format!("POSITION of vertex {} is not finite", wanted.range.start + vertex)),
            None => Ok(()),
        }
    }

    /// Normals; false where there are none.
    pub fn read_normals(&self, wanted: &Wanted, mesh: &mut Mesh) -> Result<bool, String> {
        let Some(normals) = self.expect(Semantic::Normals, wanted, 3)? else { return Ok(false) };
        normals.normalized_floats(wanted.range.clone(), |i, normal| mesh.vertices[i].normal = normal);
        let deltas = self.morphed(
            wanted,
            |target| target.normals,
            |accessor, range, put| accessor.normalized_floats(range, put),
        )?;
        for (vertex, delta) in mesh.vertices.iter_mut().zip(deltas) {
            vertex.normal = (Vec3::from(vertex.normal) + delta).to_array();
        }
        Ok(true)
    }

    /// Tangents; false where there are none.
    pub fn read_tangents(&self, wanted: &Wanted, mesh: &mut Mesh) -> Result<bool, String> {
        let Some(tangents) = self.expect(Semantic::Tangents, wanted, 4)? else { return Ok(false) };
        tangents.normalized_floats(wanted.range.clone(), |i, tangent| mesh.vertices[i].tangent = tangent);
        let deltas = self.morphed(
            wanted,
            |target| target.tangents,
            |accessor, range, put| accessor.normalized_floats(range, put),
        )?;
        for (vertex, delta) in mesh.vertices.iter_mut().zip(deltas) {
            vertex.tangent = (Vec4::from(vertex.tangent) + delta.extend(0.0)).to_array();
        }
        Ok(true)
    }

    /// The two sets of texture coordinates that a material reads; true where one is missing.
    pub fn read_uvs(&self, wanted: &Wanted, tex_coords: &TexCoords, mesh: &mut Mesh) -> Result<bool, String> {
        let mut lacks = false;
        for (uv_set, number) in tex_coords.iter().enumerate() {
            let Some(number) = *number else { continue };
            let Some(uvs) = self.expect(Semantic::TexCoords(number), wanted, 2)? else {
                lacks = true;
                continue;
            };
            uvs.floats(wanted.range.clone(), |i, uv: [f32; 2]| {
                mesh.vertices[i].uv[uv_set] = uv.map(|x| if x.is_finite() { x } else { 0.0 });
            });
        }
        Ok(lacks)
    }

    /// Vertex colours, with alpha or without.
    pub fn read_colors(&self, wanted: &Wanted, mesh: &mut Mesh) -> Result<(), String> {
        let Some(colors) = self.find(Semantic::Colors(0))? else { return Ok(()) };
        colors.expect_count(wanted.count)?;
        let range = wanted.range.clone();
        let unorm = |x: f32| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
        if colors.lanes == 4 {
            colors.normalized_floats(range, |i, rgba: [f32; 4]| mesh.vertices[i].color = rgba.map(unorm));
        } else {
            colors.expect_lanes(3)?;
            colors.normalized_floats(range, |i, [r, g, b]: [f32; 3]| {
                mesh.vertices[i].color = [unorm(r), unorm(g), unorm(b), 255];
            });
        }
        Ok(())
    }

    /// Joints and weights, by set and vertex.
    pub fn influences(&self, wanted: &Wanted) -> Result<Vec<Vec<Influences>>, String> {
        let mut sets = Vec::new();
        for number in 0.. {
            let joints = self.expect(Semantic::Joints(number), wanted, 4)?;
            let weights = self.expect(Semantic::Weights(number), wanted, 4)?;
            let (Some(joints), Some(weights)) = (joints, weights) else { break };
            let mut set: Vec<Influences> = vec![[(0.0, 0.0); 4]; wanted.range.len()];
            joints.floats(wanted.range.clone(), |i, joints: [f32; 4]| {
                set[i].iter_mut().zip(joints).for_each(|(influence, joint)| influence.0 = joint);
            });
            weights.normalized_floats(wanted.range.clone(), |i, weights: [f32; 4]| {
                set[i].iter_mut().zip(weights).for_each(|(influence, weight)| influence.1 = weight);
            });
            sets.push(set);
        }
        Ok(sets)
    }

    /// What the morph targets that weigh something add to each vertex; empty where they add nothing. `read` reads
    /// what `pick` finds.
    fn morphed(
        &self,
        wanted: &Wanted,
        pick: impl Fn(&MorphTarget) -> Option<json::Index<json::Accessor>>,
        read: impl Fn(&Accessor, Range<usize>, &mut dyn FnMut(usize, [f32; 3])),
    ) -> Result<Vec<Vec3>, String> {
        let mut sum = Vec::new();
        let targets = self.json.targets.iter().flatten().zip(self.weights).enumerate();
        for (number, (target, &weight)) in targets.filter(|(_, (_, weight))| **weight != 0.0) {
            let Some(index) = pick(target) else { continue };
            let accessor =
                self.target(wanted, index).map_err(|message| format!("targets[{number}]: {message}"))?;
            let mut deltas = vec![Vec3::ZERO; wanted.range.len()];
            read(&accessor, wanted.range.clone(), &mut |i, delta| deltas[i] = Vec3::from(delta));
            sum.resize(deltas.len(), Vec3::ZERO);
            sum.iter_mut().zip(deltas).for_each(|(sum, delta)| *sum += weight * delta);
        }
        Ok(sum)
    }

    fn target(&self, wanted: &Wanted, index: json::Index<json::Accessor>) -> Result<Accessor<'a>, String> {
        let accessor = Accessor::new(self.document, index)?;
        accessor.expect_lanes(3)?;
        accessor.expect_count(wanted.count)?;
        Ok(accessor)
    }
}
