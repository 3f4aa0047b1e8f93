//! What a scene holds, for people and for machines.

use std::fmt;

use serde::Serialize;

use super::{AlphaMode, Scene};

/// Counts, sizes and bounds of a [`Scene`]; [`fmt::Display`] prints it as text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneSummary {
    /// Name of the scene, as [`Scene::name`].
    pub name: String,
    /// Hash of the scene's files, as [`Scene::sha256`].
    pub sha256: String,
    /// Triangles drawn, instances counted each time.
    pub triangles: u64,
    /// Triangles in memory, each counted once.
    pub stored_triangles: u64,
    /// Number of vertices in memory.
    pub vertices: u64,
    /// Index ranges with a material each.
    pub primitives: u64,
    /// Primitives placed in the world.
    pub instances: u64,
    /// Materials by alpha mode.
    pub materials: MaterialCounts,
    /// Number of textures that materials use.
    pub textures: u64,
    /// Images in the order of [`Scene::images`].
    pub images: Vec<ImageSummary>,
    /// Size in bytes of all images with their mips.
    pub image_bytes: u64,
    /// Number of point and spot lights.
    pub lights: u64,
    /// How many of those are spots.
    pub spots: u64,
    /// Bounds in world space, metres; `None` where nothing is drawn.
    pub bounds: Option<BoundsSummary>,
    /// What was left out or stood in, as [`Scene::warnings`].
    pub warnings: Vec<String>,
}

/// How many materials have each alpha mode.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct MaterialCounts {
    /// Materials whose alpha is ignored.
    pub opaque: u64,
    /// Materials whose alpha is tested.
    pub mask: u64,
    /// Materials that are blended.
    pub blend: u64,
}

/// One image of the scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ImageSummary {
    /// Name of the image, as [`super::Image::name`].
    pub name: String,
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Levels, the image itself included.
    pub mips: u64,
    /// sRGB colour, else linear data.
    pub srgb: bool,
}

/// World-space corners, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BoundsSummary {
    /// Lowest corner, metres.
    pub min: [f64; 3],
    /// Highest corner, metres.
    pub max: [f64; 3],
}

impl Scene {
    /// Counts what the scene holds.
    pub fn describe(&self) -> SceneSummary {
        let count = |mode| self.materials.iter().filter(|m| m.alpha_mode == mode).count() as u64;
        let bytes = |image: &super::Image| image.mips.iter().map(|mip| mip.len() as u64).sum::<u64>();
        SceneSummary {
            name: self.name.clone(),
            sha256: self.sha256.clone(),
            triangles: self.triangle_count(),
            stored_triangles: self.primitives.iter().map(|p| u64::from(p.index_count) / 3).sum(),
            vertices: self.vertices.len() as u64,
            primitives: self.primitives.len() as u64,
            instances: self.instances.len() as u64,
            materials: MaterialCounts {
                opaque: count(AlphaMode::Opaque),
                mask: count(AlphaMode::Mask),
                blend: count(AlphaMode::Blend),
            },
            textures: self.materials.iter().map(|m| m.textures.iter().flatten().count() as u64).sum(),
            images: self.images.iter().map(ImageSummary::new).collect(),
            image_bytes: self.images.iter().map(bytes).sum(),
            lights: self.lights.len() as u64,
            spots: self.lights.iter().filter(|light| light.spot.is_some()).count() as u64,
            bounds: self
                .bounds()
                .map(|(min, max)| BoundsSummary { min: min.to_array(), max: max.to_array() }),
            warnings: self.warnings.clone(),
        }
    }
}

impl ImageSummary {
    fn new(image: &super::Image) -> Self {
        Self {
            name: image.name.clone(),
            width: image.width,
            height: image.height,
            mips: image.mips.len() as u64,
            srgb: image.srgb,
        }
    }
}

impl fmt::Display for SceneSummary {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let MaterialCounts { opaque, mask, blend } = self.materials;
        let (stored, mebibytes) = (self.stored_triangles, self.image_bytes as f64 / f64::from(1 << 20));
        writeln!(f, "scene       {}", self.name)?;
        writeln!(f, "sha256      {}", self.sha256)?;
        writeln!(f, "triangles   {} drawn, {stored} stored", self.triangles)?;
        writeln!(f, "vertices    {}", self.vertices)?;
        writeln!(f, "primitives  {} in {} instances", self.primitives, self.instances)?;
        writeln!(
            f,
            "materials   {} ({opaque} opaque, {mask} masked, {blend} blended)",
            opaque + mask + blend
        )?;
        writeln!(f, "textures    {} from {} images, {mebibytes:.1} MiB", self.textures, self.images.len())?;
        match self.spots {
            0 => writeln!(f, "lights      {}", self.lights)?,
            spots => writeln!(f, "lights      {}, of which {spots} are spots", self.lights)?,
        }
        match self.bounds {
            Some(BoundsSummary { min, max }) => {
                let size = [0, 1, 2].map(|axis| max[axis] - min[axis]);
                write!(f, "bounds      {} .. {}, size {} m", point(min), point(max), point(size))?;
            }
            None => write!(f, "bounds      none")?,
        }
        for image in &self.images {
            let size = format!("{}x{}", image.width, image.height);
            let space = if image.srgb { "sRGB" } else { "linear" };
            write!(f, "\nimage       {size:<11} {space:<6} {:>2} mips  {}", image.mips, image.name)?;
        }
        for warning in &self.warnings {
            write!(f, "\nwarning     {warning}")?;
        }
        Ok(())
    }
}

fn point([x, y, z]: [f64; 3]) -> String {
    format!("({x:.3}, {y:.3}, {z:.3})")
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec3};

    use super::super::image::Content;
    use super::super::mesh::tests::quad;
    use super::super::{Image, Instance, Material};
    use super::*;

    fn two_quads() -> Scene {
        let mut scene = Scene::empty("quads".into());
        scene.sha256 = "00ff".into();
        scene.warnings = vec!["lines left out: 2".into()];
        scene.add_mesh(quad()).unwrap();
        scene.materials = vec![Material { alpha_mode: AlphaMode::Mask, ..Material::plain("leaf") }];
        scene.images =
            vec![Image::with_mips("leaf.png", [4, 2], vec![9; 32], Content::Color { cutoff: None })];
        for x in [0.0, 10.0] {
            let world_from_object = DMat4::from_translation(DVec3::new(x, 0.0, 0.0));
            scene.instances.push(Instance { primitive: 0, world_from_object });
        }
        scene
    }

    #[test]
    fn instances_count_each_time() {
        let summary = two_quads().describe();
        assert_eq!((summary.triangles, summary.stored_triangles, summary.vertices), (4, 2, 4));
        assert_eq!(summary.materials, MaterialCounts { mask: 1, ..Default::default() });
        assert_eq!(summary.image_bytes, 4 * (8 + 2 + 1));
        assert_eq!(summary.bounds, Some(BoundsSummary { min: [0.0; 3], max: [11.0, 1.0, 0.0] }));
    }

    #[test]
    fn text_and_json_say_the_same() {
        let summary = two_quads().describe();
        let expected = "scene       quads\n\
            sha256      00ff\n\
            triangles   4 drawn, 2 stored\n\
            vertices    4\n\
            primitives  1 in 2 instances\n\
            materials   1 (0 opaque, 1 masked, 0 blended)\n\
            textures    0 from 1 images, 0.0 MiB\n\
            lights      0\n\
            bounds      (0.000, 0.000, 0.000) .. (11.000, 1.000, 0.000), size (11.000, 1.000, 0.000) m\n\
            image       4x2         sRGB    3 mips  leaf.png\n\
            warning     lines left out: 2";
        assert_eq!(summary.to_string(), expected);
        let json = serde_json::to_value(&summary).unwrap();
        assert_eq!(json["materials"]["mask"], 1);
        assert_eq!(json["images"][0]["width"], 4);
        assert_eq!(json["warnings"][0], "lines left out: 2");
    }

    #[test]
    fn validation_finds_every_kind_of_dangling_index() {
        assert_eq!(two_quads().validate().map_err(|e| e.to_string()), Ok(()));
        type Break = fn(&mut Scene);
        let broken: [(Break, &str); 8] = [
            (|s| s.indices[1] = 4, "primitive 0 uses vertex 4 of 4"),
            (|s| s.primitives[0].index_count = 9, "primitive 0 has indices beyond the end"),
            (|s| s.primitives[0].vertex_offset = 1, "primitive 0 has vertices beyond the end"),
            (|s| s.primitives[0].material = 1, "primitive 0 uses material 1"),
            (|s| s.instances[1].primitive = 1, "instance 1 draws primitive 1"),
            (|s| s.vertices[3].position[1] = f32::NAN, "not finite, at vertex 3"),
            (|s| s.images[0].mips.truncate(2), "image 0 (leaf.png) has 2 mip levels instead of 3"),
            (|s| s.instances.clear(), "has no triangle to draw"),
        ];
        for (break_it, message) in broken {
            let mut scene = two_quads();
            break_it(&mut scene);
            let error = scene.validate().unwrap_err().to_string();
            assert!(error.starts_with("scene quads: ") && error.contains(message), "{error}");
        }
    }
}
