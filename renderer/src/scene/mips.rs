//! Mip chains: what each kind of texel averages to.

use std::sync::LazyLock;

use super::image::Content;

/// The whole chain of an RGBA image, from itself down to 1x1; every level halves the one above, rounding down.
pub(super) fn chain(size: [u32; 2], texels: Vec<u8>, content: Content) -> Vec<Vec<u8>> {
    let coverage = match content {
        Content::Color { cutoff: Some(cutoff) } => Some((cutoff, coverage(&texels, cutoff))),
        _ => None,
    };
    let mut mips = vec![texels];
    let mut size = size.map(|s| s as usize);
    while size != [1, 1] {
        let above = mips.last().expect("the chain starts with the image");
        let half = size.map(|s| (s / 2).max(1));
        mips.push(match content {
            Content::Color { .. } => halve(above, size, half, color_of_four, average_color),
            Content::Data => halve(above, size, half, data_of_four, average_data),
            Content::Normal => halve(above, size, half, normal_of_four, average_normal),
        });
        size = half;
    }
    // Only now: each level is averaged from true alphas, not from scaled ones.
    if let Some((cutoff, coverage)) = coverage {
        mips.iter_mut().skip(1).for_each(|mip| keep_coverage(mip, cutoff, coverage));
    }
    mips
}

/// A texel and its weight.
type Tap = ([u8; 4], u32);

/// Box-filters one level: by `four` where both sides are even, else by `average`, which says the same.
fn halve(
    above: &[u8],
    size: [usize; 2],
    half: [usize; 2],
    four: impl Fn([[u8; 4]; 4]) -> [u8; 4],
    average: impl Fn(&[Tap]) -> [u8; 4],
) -> Vec<u8> {
    if size == half.map(|h| 2 * h) {
        halve_even(above, size[0], four)
    } else {
        halve_any(above, size, half, average)
    }
}

/// The fast path, for sides that are both even.
fn halve_even(above: &[u8], width: usize, four: impl Fn([[u8; 4]; 4]) -> [u8; 4]) -> Vec<u8> {
    let mut below = Vec::with_capacity(above.len() / 4);
    for rows in above.chunks_exact(2 * 4 * width) {
        let (upper, lower) = rows.split_at(4 * width);
        let pairs = upper.as_chunks::<8>().0.iter().zip(lower.as_chunks::<8>().0);
        for (&[a, b, c, d, e, f, g, h], &[i, j, k, l, m, n, o, p]) in pairs {
            below.extend_from_slice(&four([[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]]));
        }
    }
    below
}

/// An odd side has three taps a texel, weighted so that every texel above counts the same (NVIDIA,
/// "Non-Power-of-Two Mipmapping", 2005).
fn halve_any(
    above: &[u8],
    size: [usize; 2],
    half: [usize; 2],
    average: impl Fn(&[Tap]) -> [u8; 4],
) -> Vec<u8> {
    let texels = above.as_chunks::<4>().0;
    let columns: Vec<_> = (0..half[0]).map(|x| taps(size[0], half[0], x)).collect();
    let mut below = Vec::with_capacity(half[0] * half[1] * 4);
    for y in 0..half[1] {
        let rows = taps(size[1], half[1], y);
        for column in &columns {
            let mut block = [([0; 4], 0); 9];
            let mut used = 0;
            for &(row, row_weight) in rows.used() {
                for &(column, column_weight) in column.used() {
                    block[used] = (texels[row * size[0] + column], row_weight * column_weight);
                    used += 1;
                }
            }
            below.extend(average(&block[..used]));
        }
    }
    below
}

/// Up to three positions and weights along one axis.
struct Taps {
    taps: [(usize, u32); 3],
    count: usize,
}

impl Taps {
    fn used(&self) -> &[(usize, u32)] {
        &self.taps[..self.count]
    }
}

/// What position `i` of `half` covers of `size`.
fn taps(size: usize, half: usize, i: usize) -> Taps {
    let (first, n) = (2 * i, half as u32);
    if size == 1 {
        Taps { taps: [(0, 1); 3], count: 1 }
    } else if size == 2 * half {
        Taps { taps: [(first, 1), (first + 1, 1), (0, 0)], count: 2 }
    } else {
        let i = i as u32;
        Taps { taps: [(first, n - i), (first + 1, n), (first + 2, i + 1)], count: 3 }
    }
}

/// Weighted mean of `value` over the taps, rounded.
fn mean(taps: &[Tap], value: impl Fn(&[u8; 4]) -> u32) -> u32 {
    let (sum, weight) = taps.iter().fold((0_u64, 0_u64), |(sum, all), (texel, weight)| {
        (sum + u64::from(value(texel)) * u64::from(*weight), all + u64::from(*weight))
    });
    ((sum + weight / 2) / weight) as u32
}

fn average_color(taps: &[Tap]) -> [u8; 4] {
    let tables = &*SRGB;
    let linear = |c: usize| mean(taps, |texel| u32::from(tables.to_linear[usize::from(texel[c])]));
    let encoded = |c: usize| tables.from_linear[linear(c) as usize];
    [encoded(0), encoded(1), encoded(2), mean(taps, |texel| texel[3].into()) as u8]
}

fn average_data(taps: &[Tap]) -> [u8; 4] {
    std::array::from_fn(|c| mean(taps, |texel| texel[c].into()) as u8)
}

fn average_normal(taps: &[Tap]) -> [u8; 4] {
    let sum = |c: usize| taps.iter().map(|(texel, weight)| direction(texel[c]) * *weight as f32).sum();
    unit_normal([sum(0), sum(1), sum(2)], mean(taps, |texel| texel[3].into()) as u8)
}

/// A code of a normal map as a number, 255 for 1.
fn direction(code: u8) -> f32 {
    f32::from(code) * 2.0 - 255.0
}

/// Encodes the mean direction as a unit vector again; straight up where directions cancel.
fn unit_normal([x, y, z]: [f32; 3], alpha: u8) -> [u8; 4] {
    let length = (x * x + y * y + z * z).sqrt();
    if length == 0.0 {
        return [128, 128, 255, alpha];
    }
    let scale = 127.5 / length;
    let encode = |v: f32| (v * scale + 128.0) as u8;
    [encode(x), encode(y), encode(z), alpha]
}

fn color_of_four(texels: [[u8; 4]; 4]) -> [u8; 4] {
    let tables = &*SRGB;
    let light = |i: usize, c: usize| u32::from(tables.to_linear[usize::from(texels[i][c])]);
    let mean = |c: usize| (light(0, c) + light(1, c) + light(2, c) + light(3, c) + 2) / 4;
    let encoded = |c: usize| tables.from_linear[mean(c) as usize];
    [encoded(0), encoded(1), encoded(2), mean_of_four(&texels, 3)]
}

fn data_of_four(texels: [[u8; 4]; 4]) -> [u8; 4] {
    let mean = |c: usize| mean_of_four(&texels, c);
    [mean(0), mean(1), mean(2), mean(3)]
}

fn normal_of_four(texels: [[u8; 4]; 4]) -> [u8; 4] {
    let value = |i: usize, c: usize| direction(texels[i][c]);
    let sum = |c: usize| value(0, c) + value(1, c) + value(2, c) + value(3, c);
    unit_normal([sum(0), sum(1), sum(2)], mean_of_four(&texels, 3))
}

fn mean_of_four(texels: &[[u8; 4]; 4], c: usize) -> u8 {
    let value = |i: usize| u16::from(texels[i][c]);
    ((value(0) + value(1) + value(2) + value(3) + 2) / 4) as u8
}

/// Share of texels that an alpha test at `cutoff` keeps.
fn coverage(texels: &[u8], cutoff: u8) -> f64 {
    let texels = texels.as_chunks::<4>().0;
    texels.iter().filter(|t| t[3] >= cutoff).count() as f64 / texels.len() as f64
}

/// Scales a level's alphas up until the alpha test keeps the share it keeps of the image itself, so that
/// foliage does not thin out with distance (Castaño, "Computing Alpha Mipmaps", 2010).
fn keep_coverage(mip: &mut [u8], cutoff: u8, coverage: f64) {
    let mut histogram = [0_usize; 256];
    mip.as_chunks::<4>().0.iter().for_each(|t| histogram[usize::from(t[3])] += 1);
    let wanted = (coverage * (mip.len() / 4) as f64).round() as usize;
    let mut kept = 0;
    let threshold = (1..=255).rev().find(|&alpha| {
        kept += histogram[alpha];
        kept >= wanted
    });
    // `None`: too few texels are not wholly clear. Never scaled down: that only brings solid texels to the edge.
    let Some(threshold) = threshold.filter(|&threshold| threshold < usize::from(cutoff)) else { return };
    for texel in mip.as_chunks_mut::<4>().0 {
        let scaled = (usize::from(texel[3]) * usize::from(cutoff)).div_ceil(threshold);
        texel[3] = scaled.min(255) as u8;
    }
}

/// The sRGB transfer function (IEC 61966-2-1) between 8-bit codes and 16-bit linear light.
struct SrgbTables {
    to_linear: [u16; 256],
    /// The code whose light is nearest.
    from_linear: Vec<u8>,
}

static SRGB: LazyLock<SrgbTables> = LazyLock::new(|| {
    let to_linear: [u16; 256] = std::array::from_fn(|code| {
        let encoded = code as f64 / 255.0;
        let light = if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
        (light * 65535.0).round() as u16
    });
    let mut code = 0;
    let from_linear = (0..=65535_u32)
        .map(|light| {
            let middle = |c: usize| (u32::from(to_linear[c]) + u32::from(to_linear[c + 1])).div_ceil(2);
            while code < 255 && light >= middle(code) {
                code += 1;
            }
            code as u8
        })
        .collect();
    SrgbTables { to_linear, from_linear }
});

/// The sRGB code nearest to linear light of 0 to 1.
pub(super) fn srgb_code(light: f32) -> u8 {
    SRGB.from_linear[(light * 65535.0).round() as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLOR: Content = Content::Color { cutoff: None };

    #[test]
    fn colors_average_as_light() {
        // Half black, half white is 50 % light: code 188, not 128.
        let texels = vec![0, 0, 0, 0, 255, 255, 255, 255];
        assert_eq!(chain([2, 1], texels, COLOR)[1], [188, 188, 188, 128]);
    }

    #[test]
    fn data_averages_as_numbers() {
        let texels = vec![0, 10, 0, 0, 255, 11, 0, 255];
        assert_eq!(chain([1, 2], texels, Content::Data)[1], [128, 11, 0, 128]);
    }

    #[test]
    fn every_code_survives_as_a_uniform_image() {
        for code in 0..=255_u8 {
            for content in [COLOR, Content::Data] {
                let mips = chain([5, 3], vec![code; 5 * 3 * 4], content);
                assert_eq!(mips.iter().map(Vec::len).collect::<Vec<_>>(), [60, 8, 4]);
                assert!(mips.iter().flatten().all(|&c| c == code), "{code} {content:?}");
            }
        }
    }

    #[test]
    fn the_fast_path_equals_the_general_one() {
        let texels: Vec<_> =
            (0..8 * 6 * 4_u32).map(|i| (i.wrapping_mul(2_654_435_769) >> 24) as u8).collect();
        let general = |average: fn(&[Tap]) -> [u8; 4]| halve_any(&texels, [8, 6], [4, 3], average);
        assert_eq!(halve_even(&texels, 8, color_of_four), general(average_color));
        assert_eq!(halve_even(&texels, 8, data_of_four), general(average_data));
        assert_eq!(halve_even(&texels, 8, normal_of_four), general(average_normal));
    }

    #[test]
    fn odd_sides_weigh_every_texel_alike() {
        // One lit column of five: the 2x1 level must hold a fifth of the light, wherever the column is.
        for lit in 0..5 {
            let texels: Vec<_> = (0..5).flat_map(|x| [if x == lit { 250 } else { 0 }; 4]).collect();
            let mips = chain([5, 1], texels, Content::Data);
            assert_eq!(u32::from(mips[1][0]) + u32::from(mips[1][4]), 100, "column {lit}");
            assert_eq!(mips[2][0], 50);
        }
    }

    #[test]
    fn normals_stay_unit_vectors() {
        // Left-tilted and right-tilted by 45 degrees: their mean points straight out, at full length.
        let texels = vec![218, 128, 218, 255, 37, 128, 218, 255];
        let mean = &chain([2, 1], texels, Content::Normal)[1];
        assert!(mean[0].abs_diff(128) <= 1 && mean[1].abs_diff(128) <= 1 && mean[2] >= 254, "{mean:?}");
        let cancelling = vec![255, 128, 128, 255, 0, 127, 127, 255];
        assert_eq!(chain([2, 1], cancelling, Content::Normal)[1], [128, 128, 255, 255]);
    }

    #[test]
    fn masks_keep_their_coverage() {
        // Lone opaque texels, one in four: every averaged alpha is 64, below the cut-off.
        let texels: Vec<_> =
            (0..64 * 64_u32).flat_map(|i| [0, 0, 0, if (i + i / 64) % 4 == 0 { 255 } else { 0 }]).collect();
        let plain = chain([64, 64], texels.clone(), COLOR);
        let masked = chain([64, 64], texels, Content::Color { cutoff: Some(128) });
        assert_eq!(coverage(&plain[1], 128), 0.0);
        assert!(coverage(&masked[1], 128) >= 0.25);
        assert_eq!(masked[0], plain[0]);
        let solid = chain([4, 4], vec![255; 64], Content::Color { cutoff: Some(128) });
        assert!(solid.iter().flatten().all(|&code| code == 255));
    }
}
