//! The hash tables of an octree as pictures: of each depth that of its branches, and beside it that of the leaves below.
//!
//! ```text
//! slots, a slice of the cube behind the other      slots of the leaves
//! offsets, likewise                                 offsets of the leaves
//! ```

use crate::octree::{HashTable, Layer, LinklessOctree, StoredKind};
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

/// Between slices, and behind tables that are smaller.
const GAP: Rgb<u8> = Rgb([24, 24, 32]);
/// A slot that no key takes.
const FREE: Rgb<u8> = Rgb([70, 70, 78]);
/// A slot that a branch takes.
const BRANCH: Rgb<u8> = Rgb([240, 228, 66]);
/// A slot that a leaf takes.
const LEAF: Rgb<u8> = Rgb([86, 180, 233]);

/// Pictures that are not this wide have larger pixels.
const WIDTH: u32 = 640;

/// Space around panels, pixels.
const MARGIN: u32 = 4;

/// A picture of the tables of one depth.
pub struct TablePicture {
    /// Depth of the branches.
    pub depth: u32,
    /// What it shows.
    pub image: RgbImage,
}

/// A cube of colours, laid out slice by slice in rows.
struct Panel<'a> {
    side: u32,
    color: Box<dyn Fn(usize) -> Rgb<u8> + 'a>,
}

impl Panel<'_> {
    /// Slices in a row, about as many as there are rows.
    fn columns(&self) -> u32 {
        f64::from(self.side).sqrt().ceil() as u32
    }

    /// Width and height, pixels.
    fn size(&self) -> [u32; 2] {
        let columns = self.columns();
        [columns, self.side.div_ceil(columns)].map(|slices| slices * (self.side + 1))
    }

    fn paint(&self, image: &mut RgbImage, [left, top]: [u32; 2]) {
        let side = self.side;
        for index in 0..(side as usize).pow(3) {
            let [x, y, z] = [1, side, side * side].map(|stride| index as u32 / stride % side);
            let slice = [z % self.columns(), z / self.columns()].map(|place| place * (side + 1));
            image.put_pixel(left + slice[0] + x, top + slice[1] + y, (self.color)(index));
        }
    }
}

/// A picture of each depth's tables.
pub fn pictures(octree: &LinklessOctree) -> Vec<TablePicture> {
    let taken = Taken::of(octree);
    let layers = octree.layers.iter().zip(octree.frame.start_depth..);
    let of_layer = |(layer, depth)| TablePicture { depth, image: enlarged(&picture(octree, layer, &taken)) };
    layers.map(of_layer).collect()
}

/// A pixel for each entry of a layer's tables.
fn picture(octree: &LinklessOctree, layer: &Layer, taken: &Taken) -> RgbImage {
    let branches = panels(octree, &layer.structure, (&taken.branches, BRANCH));
    let leaves = layer.data.as_ref().map(|table| panels(octree, table, (&taken.leaves, LEAF)));
    let columns: Vec<[Panel; 2]> = [Some(branches), leaves].into_iter().flatten().collect();
    compose(&columns)
}

/// Small tables with several pixels for each of their entries.
fn enlarged(image: &RgbImage) -> RgbImage {
    let scale = (WIDTH / image.width()).clamp(1, 8);
    imageops::resize(image, scale * image.width(), scale * image.height(), FilterType::Nearest)
}

/// Which slots hold a key.
struct Taken {
    branches: Vec<bool>,
    leaves: Vec<bool>,
}

impl Taken {
    fn of(octree: &LinklessOctree) -> Self {
        let mut taken =
            Self { branches: vec![false; octree.structure.len()], leaves: vec![false; octree.leaves.len()] };
        for node in octree.stored_nodes() {
            match node.kind {
                StoredKind::Branch => taken.branches[node.slot] = true,
                StoredKind::Leaf => taken.leaves[node.slot] = true,
            }
        }
        taken
    }
}

/// The slots of a table, and below them its offsets, x, y and z as red, green and blue.
fn panels<'a>(
    octree: &'a LinklessOctree,
    table: &HashTable,
    (taken, color): (&'a [bool], Rgb<u8>),
) -> [Panel<'a>; 2] {
    let (slots, offsets) = (table.slots as usize, table.offsets as usize);
    let largest = table.side.clamp(2, 256) - 1;
    let scaled = move |part: u8| (u32::from(part) * 255 / largest).min(255) as u8;
    [
        Panel {
            side: table.side,
            color: Box::new(move |slot| if taken[slots + slot] { color } else { FREE }),
        },
        Panel {
            side: table.offset_side,
            color: Box::new(move |place| {
                let [x, y, z, _] = octree.offsets[offsets + place];
                Rgb([x, y, z].map(scaled))
            }),
        },
    ]
}

/// Columns of panels, side by side.
fn compose(columns: &[[Panel; 2]]) -> RgbImage {
    let sizes: Vec<[[u32; 2]; 2]> = columns.iter().map(|panels| panels.each_ref().map(Panel::size)).collect();
    let widths: Vec<u32> = sizes.iter().map(|[a, b]| a[0].max(b[0])).collect();
    let top_height = sizes.iter().map(|[top, _]| top[1]).max().unwrap_or(0);
    let bottom_height = sizes.iter().map(|[_, bottom]| bottom[1]).max().unwrap_or(0);
    let width = widths.iter().map(|width| width + MARGIN).sum::<u32>() + MARGIN;
    let mut image = RgbImage::from_pixel(width, top_height + bottom_height + 3 * MARGIN, GAP);
    let mut left = MARGIN;
    for (panels, width) in columns.iter().zip(widths) {
        panels[0].paint(&mut image, [left, MARGIN]);
        panels[1].paint(&mut image, [left, top_height + 2 * MARGIN]);
        left += width + MARGIN;
    }
    image
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::LightVolume;
    use crate::octree::OctreeSettings;
    use glam::DVec3;

    #[test]
    fn every_key_is_a_pixel_of_its_table() {
        let lights = [0.0, 5.0, -4.0].map(|x| LightVolume::sphere(DVec3::splat(x), 2.0));
        let octree = LinklessOctree::build(&lights, &OctreeSettings::new(1.0, 1)).unwrap().octree;
        let taken = Taken::of(&octree);
        let pictures = pictures(&octree);
        assert_eq!(pictures.len(), octree.layers.len());
        for (enlarged, layer) in pictures.iter().zip(&octree.layers) {
            let small = picture(&octree, layer, &taken);
            let scale = enlarged.image.width() / small.width();
            assert!(scale > 1 && enlarged.image.height() == scale * small.height());
            let pixels = |color| small.pixels().filter(|pixel| **pixel == color).count();
            let slots = |table: &HashTable| (table.side as usize).pow(3);
            let (branches, leaves) = (&layer.structure, layer.data.as_ref());
            assert_eq!(pixels(BRANCH), branches.keys as usize, "depth {}", enlarged.depth);
            assert_eq!(pixels(LEAF), leaves.map_or(0, |table| table.keys as usize));
            let free = slots(branches) + leaves.map_or(0, slots) - pixels(BRANCH) - pixels(LEAF);
            assert_eq!(pixels(FREE), free);
        }
    }
}
