//! GLB: JSON and one buffer in one file (glTF 2.0, section 4.4).
//!
//! Where writers disagree the chunks decide: the total length in the header is not trusted, a chunk may follow
//! the last one with or without padding, and chunks of other kinds are passed over.

use std::ops::Range;

/// First bytes of every GLB file.
const MAGIC: &[u8; 4] = b"glTF";
/// Magic, version, total length.
const HEADER: usize = 12;
/// Length and kind, in front of each chunk.
const CHUNK_HEADER: usize = 8;

/// Where the parts of a GLB file lie in its bytes.
#[derive(Debug, PartialEq)]
pub(super) struct Chunks {
    pub json: Range<usize>,
    /// What a buffer without a uri holds.
    pub binary: Option<Range<usize>>,
}

/// Whether a file is GLB, and not JSON.
pub(super) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Finds the chunks of a GLB file.
pub(super) fn chunks(bytes: &[u8]) -> Result<Chunks, String> {
    let header = |at: usize| {
        word(bytes, at).ok_or_else(|| format!("is truncated: its GLB header ends at byte {}", bytes.len()))
    };
    let (version, length) = (header(4)?, header(8)? as usize);
    if version != 2 {
        return Err(format!("is GLB version {version}; 2 is read: export as glTF 2.0"));
    }
    let mut json = None;
    let mut at = HEADER;
    while let Some((kind, range)) = chunk(bytes, at, json.is_some()) {
        if range.end > bytes.len() {
            let needed = length.max(range.end);
            return Err(format!("is truncated: {} bytes of {needed}", bytes.len()));
        }
        at = range.end;
        match (&kind, &json) {
            (b"JSON", None) => json = Some(range),
            (b"BIN\0", Some(json)) => return Ok(Chunks { json: json.clone(), binary: Some(range) }),
            _ => {}
        }
    }
    json.map(|json| Chunks { json, binary: None }).ok_or_else(|| "is corrupt: it has no JSON chunk".into())
}

/// Kind and bytes of the chunk at `at`, or behind the padding there. Behind the JSON only what a kind of four
/// printable characters (or BIN) announces is a chunk: writers leave other bytes there too.
fn chunk(bytes: &[u8], at: usize, behind_json: bool) -> Option<([u8; 4], Range<usize>)> {
    let read = |at: usize| {
        let kind = word(bytes, at + 4)?.to_le_bytes();
        let start = at + CHUNK_HEADER;
        Some((kind, start..start + word(bytes, at)? as usize))
    };
    let sound = |(kind, _): &([u8; 4], Range<usize>)| {
        !behind_json || kind == b"BIN\0" || kind.iter().all(u8::is_ascii_graphic)
    };
    read(at).filter(sound).or_else(|| read(at.next_multiple_of(4)).filter(sound))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at + 4)?.try_into().ok()?;
    Some(u32::from_le_bytes(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(chunks: &[&[u8]]) -> Vec<u8> {
        let body = chunks.concat();
        let length = (HEADER + body.len()) as u32;
        [MAGIC.as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes(), &body].concat()
    }

    fn part(kind: &[u8; 4], bytes: &[u8]) -> Vec<u8> {
        [&(bytes.len() as u32).to_le_bytes(), kind.as_slice(), bytes].concat()
    }

    fn contents(file: &[u8]) -> (&[u8], Option<&[u8]>) {
        let Chunks { json, binary } = chunks(file).unwrap();
        (&file[json], binary.map(|range| &file[range]))
    }

    #[test]
    fn chunks_are_found_with_and_without_padding() {
        let (json, bin) = (part(b"JSON", b"{....}"), part(b"BIN\0", b"12345"));
        let expected = (b"{....}".as_slice(), Some(b"12345".as_slice()));
        assert_eq!(contents(&glb(&[&json, &bin])), expected);
        assert_eq!(contents(&glb(&[&json, b"  ", &bin])), expected, "padding that the length leaves out");
        assert_eq!(contents(&glb(&[&json, b"\0\0", &bin, b"\0\0\0"])), expected);
        assert_eq!(contents(&glb(&[&json])), (expected.0, None));
        assert_eq!(contents(&glb(&[&json, b"  "])), (expected.0, None));
    }

    #[test]
    fn other_chunks_and_a_wrong_length_are_passed_over() {
        let (json, bin) = (part(b"JSON", b"{...}   "), part(b"BIN\0", b"1234"));
        let expected = (b"{...}   ".as_slice(), Some(b"1234".as_slice()));
        let mut file = glb(&[&json, &part(b"META", b"abcd"), &bin, &part(b"MORE", b"efgh")]);
        assert_eq!(contents(&file), expected);
        for length in [0, 40, u32::MAX] {
            file[8..12].copy_from_slice(&length.to_le_bytes());
            assert_eq!(contents(&file), expected);
        }
        let mut empty = glb(&[&json, &part(b"BIN\0", b"")]);
        assert_eq!(contents(&empty), (expected.0, Some(b"".as_slice())));
        empty.truncate(HEADER);
        assert_eq!(chunks(&empty).unwrap_err(), "is corrupt: it has no JSON chunk");
    }
}
