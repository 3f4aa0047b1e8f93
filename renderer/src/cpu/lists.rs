//! Lists on their way to `light_indices`: read off bits, or sorted.

/// Lists of numbers as they are found, one a visible cluster.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FoundLists {
    /// Numbers of the lights on each list, in the order in which they were found.
    pub lights: Vec<Vec<u32>>,
    /// Entries of each list of which f32 may decide otherwise.
    pub borderline: Vec<Vec<u32>>,
}

impl FoundLists {
    /// Begins the list of the next visible cluster.
    pub(super) fn start_list(&mut self) {
        self.lights.push(vec![]);
        self.borderline.push(vec![]);
    }

    /// Takes a light, by the margin (metres) of its test against the cluster of the last list.
    pub(super) fn add(&mut self, number: u32, margin: f64, epsilon: f64) {
        let (Some(list), Some(close)) = (self.lights.last_mut(), self.borderline.last_mut()) else { return };
        if margin >= 0.0 {
            list.push(number);
        }
        if margin.abs() < epsilon {
            close.push(number);
        }
    }
}

/// The numbers on each list whose bits are a row of `words` words in `masks`, ascending.
pub fn read_masks(masks: &[u32], words: usize) -> Vec<Vec<u32>> {
    let numbers = |row: &[u32]| {
        let bit = |number: &u32| row[*number as usize / 32] >> (number % 32) & 1 == 1;
        (0..32 * row.len() as u32).filter(bit).collect()
    };
    masks.chunks_exact(words.max(1)).map(numbers).collect()
}

/// A list that was written in any order, by ascending light: `light_of` tells the light behind each number.
pub fn sort_lists(numbers: &[u32], light_of: impl Fn(u32) -> u32) -> Vec<u32> {
    let mut lights: Vec<u32> = numbers.iter().map(|&number| light_of(number)).collect();
    lights.sort_unstable();
    lights
}

/// What is kept of a list that ascends where at most `most` lights have room, and how many are dropped.
pub fn cap_list(lights: &[u32], most: u32) -> (&[u32], u64) {
    let (kept, dropped) = lights.split_at(lights.len().min(most as usize));
    (kept, dropped.len() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_numbers() {
        assert_eq!(read_masks(&[0b101, 1 << 31, 0, 0b10], 2), [vec![0, 2, 63], vec![33]]);
        assert_eq!(read_masks(&[], 0), Vec::<Vec<u32>>::new());
    }

    #[test]
    fn sorted_lists_are_of_lights() {
        assert_eq!(sort_lists(&[2, 0, 1], |number| 10 * number + 3), [3, 13, 23]);
    }

    #[test]
    fn full_lists_keep_their_first_lights() {
        assert_eq!(cap_list(&[2, 3, 7], 2), (&[2, 3][..], 1));
        assert_eq!(cap_list(&[2, 3, 7], 3), (&[2, 3, 7][..], 0));
        assert_eq!(cap_list(&[], 1), (&[][..], 0));
    }

    #[test]
    fn what_is_too_close_to_call_is_said() {
        let mut lists = FoundLists::default();
        lists.start_list();
        for (number, margin) in [(7, 1.0), (3, -1.0), (5, 0.01), (9, -0.01)] {
            lists.add(number, margin, 0.1);
        }
        assert_eq!((lists.lights, lists.borderline), (vec![vec![7, 5]], vec![vec![5, 9]]));
    }
}
