//! What an octree's tables take.

use super::linkless::{HashTable, LinklessOctree};

/// What the tables of one perfect hash take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TableMemory {
    /// Keys stored.
    pub keys: u64,
    /// Slots along an axis, `m`.
    pub side: u32,
    /// Offsets along an axis, `r`.
    pub offset_side: u32,
    /// Bytes of all slots: 2 each for what branches' children are, 8 for leaves.
    pub slot_bytes: u64,
    /// Bytes of all offsets: 4 each, where Tegelaers counts 3.
    pub offset_bytes: u64,
}

/// What one layer takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LayerMemory {
    /// Depth of the layer's branches; its leaves are one deeper.
    pub depth: u32,
    /// Branches.
    pub structure: TableMemory,
    /// Leaves with lights, where there are some.
    pub data: Option<TableMemory>,
}

impl TableMemory {
    fn of(table: &HashTable, slot_bytes: usize) -> Self {
        let &HashTable { keys, side, offset_side, .. } = table;
        let slot_bytes = u64::from(side).pow(3) * slot_bytes as u64;
        let offset_bytes = u64::from(offset_side).pow(3) * size_of::<[u8; 4]>() as u64;
        Self { keys: keys.into(), side, offset_side, slot_bytes, offset_bytes }
    }

    /// Slots and offsets together: the texels that Tegelaers plots.
    pub fn texels(&self) -> u64 {
        u64::from(self.side).pow(3) + u64::from(self.offset_side).pow(3)
    }

    /// Bytes of slots and offsets.
    pub fn bytes(&self) -> u64 {
        self.slot_bytes + self.offset_bytes
    }
}

impl LinklessOctree {
    /// How many tables there are.
    pub fn table_count(&self) -> u64 {
        self.layers.iter().map(|layer| 1 + u64::from(layer.data.is_some())).sum()
    }

    /// How many nodes all tables hold.
    pub fn nodes(&self) -> u64 {
        let tables = self.layers.iter().flat_map(|layer| [Some(layer.structure), layer.data]);
        tables.flatten().map(|table| u64::from(table.keys)).sum()
    }

    /// What each layer's tables take, without the light indices.
    pub fn memory(&self) -> Vec<LayerMemory> {
        let layers = self.layers.iter().zip(self.frame.start_depth..);
        let memory = layers.map(|(layer, depth)| LayerMemory {
            depth,
            structure: TableMemory::of(&layer.structure, size_of::<u16>()),
            data: layer.data.as_ref().map(|table| TableMemory::of(table, size_of::<[u32; 2]>())),
        });
        memory.collect()
    }

    /// Slots and offsets of all tables.
    pub fn texels(&self) -> u64 {
        self.tables().map(|table| table.texels()).sum()
    }

    /// Bytes of all tables and of the light indices.
    pub fn bytes(&self) -> u64 {
        let tables: u64 = self.tables().map(|table| table.bytes()).sum();
        tables + size_of_val(self.indices.as_slice()) as u64
    }

    fn tables(&self) -> impl Iterator<Item = TableMemory> {
        self.memory().into_iter().flat_map(|layer| std::iter::once(layer.structure).chain(layer.data))
    }
}
