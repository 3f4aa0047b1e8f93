//! Triangles of a primitive (glTF 2.0, section 3.7.2.1).

use std::ops::Range;

use gltf::json;
use json::mesh::Mode;

use super::accessor::Accessor;
use super::document::Document;

/// The vertices in use and the triangles between them, counted from the first in use: primitives that share one
/// large accessor take only their part of it. `count` vertices there are.
pub(super) fn topology(
    document: &Document,
    indices: Option<json::Index<json::Accessor>>,
    (mode, count): (Mode, usize),
) -> Result<(Range<usize>, Vec<u32>), String> {
    let listed = match indices {
        Some(index) => Accessor::new(document, index).and_then(|accessor| accessor.indices()),
        None => {
            u32::try_from(count).map(|count| (0..count).collect()).map_err(|_| "too many vertices".into())
        }
    };
    let mut indices = triangles(mode, listed.map_err(|message| format!("indices: {message}"))?)?;
    let (Some(&first), Some(&last)) = (indices.iter().min(), indices.iter().max()) else {
        return Ok((0..0, indices));
    };
    if last as usize >= count {
        return Err(format!("indices: use vertex {last} of {count}"));
    }
    indices.iter_mut().for_each(|index| *index -= first);
    Ok((first as usize..last as usize + 1, indices))
}

/// The triangle list of any topology of triangles (glTF 2.0, section 3.7.2.1); a strip's stitches are dropped.
fn triangles(mode: Mode, indices: Vec<u32>) -> Result<Vec<u32>, String> {
    let list: Vec<[u32; 3]> = match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(i, v)| if i % 2 == 0 { [v[0], v[1], v[2]] } else { [v[0], v[2], v[1]] })
            .collect(),
        Mode::TriangleFan => indices.windows(2).skip(1).map(|v| [v[0], v[1], indices[0]]).collect(),
        _ if !indices.len().is_multiple_of(3) => {
            return Err(format!("has {} indices, which do not make whole triangles", indices.len()));
        }
        _ => return Ok(indices),
    };
    Ok(list.into_iter().filter(|[a, b, c]| a != b && b != c && c != a).flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_winding() {
        let strip = triangles(Mode::TriangleStrip, vec![0, 1, 2, 3, 3, 4, 4]).unwrap();
        assert_eq!(strip, [0, 1, 2, 1, 3, 2]);
        let fan = triangles(Mode::TriangleFan, vec![7, 1, 2, 3]).unwrap();
        assert_eq!(fan, [1, 2, 7, 2, 3, 7]);
        assert!(triangles(Mode::TriangleFan, vec![7]).unwrap().is_empty());
        assert!(triangles(Mode::Triangles, vec![0, 1]).unwrap_err().contains("2 indices"));
    }
}
