//! Bytes of text files as text, whichever program wrote them.
//!
//! Text is UTF-8 or, with a byte-order mark, UTF-16; lines end with LF, CR LF or CR. What comes out has no mark, no NUL
//! bytes, and LF alone, so that every reader counts the same lines.

use std::borrow::Cow;

/// Text of a format whose characters matter: JSON, CSV.
///
/// # Errors
/// What is wrong with the bytes, and where.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, String> {
    let bytes = unpadded(bytes);
    let text = match utf16(bytes)? {
        Some(text) => Cow::Owned(text),
        None => Cow::Borrowed(utf8(bytes)?),
    };
    finish(text)
}

/// Text of a format that programs write in the encoding of their machine; each byte that is not UTF-8 is read as
/// Latin-1. Also the line, from 1, of the first such byte.
///
/// # Errors
/// As [`decode`], but for text that is not UTF-8.
pub fn decode_any(bytes: &[u8]) -> Result<(Cow<'_, str>, Option<usize>), String> {
    if let Ok(text) = decode(bytes) {
        return Ok((text, None));
    }
    let bytes = unpadded(bytes);
    if let Some(text) = utf16(bytes)? {
        return Ok((finish(Cow::Owned(text))?, None));
    }
    let mut text = String::with_capacity(bytes.len());
    let mut odd = None;
    for chunk in without_mark(bytes).utf8_chunks() {
        text.push_str(chunk.valid());
        if !chunk.invalid().is_empty() {
            odd.get_or_insert(text.len());
        }
        text.extend(chunk.invalid().iter().copied().map(char::from));
    }
    let line = odd.map(|odd| line_at(text.as_bytes(), odd));
    Ok((finish(Cow::Owned(text))?, line))
}

/// Without what fills a file or a chunk up to a round size.
fn unpadded(bytes: &[u8]) -> &[u8] {
    // UTF-16 text may end with half a character that is zero.
    if is_utf16(bytes) {
        return bytes;
    }
    let end = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    &bytes[..end]
}

fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

/// The text after a UTF-16 byte-order mark; `None` without one.
fn utf16(bytes: &[u8]) -> Result<Option<String>, String> {
    if bytes.starts_with(b"\xff\xfe\0\0") {
        return Err("is UTF-32 text; save it as UTF-8".into());
    }
    if !is_utf16(bytes) {
        return Ok(None);
    }
    let unit = if bytes[0] == 0xff { u16::from_le_bytes } else { u16::from_be_bytes };
    let (units, rest) = bytes[2..].as_chunks::<2>();
    if !rest.is_empty() {
        return Err("is UTF-16 text that ends within a character; save it as UTF-8".into());
    }
    let text: Result<String, _> = char::decode_utf16(units.iter().map(|&pair| unit(pair))).collect();
    text.map(Some).map_err(|error| format!("is not UTF-16 text as its mark says: {error}; save it as UTF-8"))
}

fn utf8(bytes: &[u8]) -> Result<&str, String> {
    let mark = bytes.len() - without_mark(bytes).len();
    std::str::from_utf8(without_mark(bytes)).map_err(|error| {
        let byte = mark + error.valid_up_to();
        format!("line {}: is not UTF-8 text, at byte {byte}", line_at(bytes, byte))
    })
}

/// Refuses NUL bytes and makes every line end with LF.
fn finish(text: Cow<'_, str>) -> Result<Cow<'_, str>, String> {
    if let Some(nul) = text.find('\0') {
        let line = line_at(text.as_bytes(), nul);
        return Err(format!(
            "line {line}: holds a NUL byte: it is no text, or UTF-16 without its byte-order mark; save it as UTF-8"
        ));
    }
    if text.contains('\r') {
        return Ok(text.replace("\r\n", "\n").replace('\r', "\n").into());
    }
    Ok(text)
}

/// The line, from 1, of a byte of `text`, whichever ends its lines have.
fn line_at(text: &[u8], byte: usize) -> usize {
    let before = &text[..byte];
    let carriage_return = |i: usize| before[i] == b'\r' && before.get(i + 1) != Some(&b'\n');
    1 + (0..before.len()).filter(|&i| before[i] == b'\n' || carriage_return(i)).count()
}

/// `size` in the largest binary unit that keeps it above one, for messages.
pub fn bytes_text(size: u64) -> String {
    match size {
        0..1024 => format!("{size} B"),
        1024..0x10_0000 => format!("{:.1} KiB", size as f64 / 1024.0),
        0x10_0000..0x4000_0000 => format!("{:.1} MiB", size as f64 / 1_048_576.0),
        _ => format!("{:.1} GiB", size as f64 / 1_073_741_824.0),
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// `text` in every encoding and with every line end that is read.
    pub(crate) fn spellings(text: &str) -> Vec<Vec<u8>> {
        let mut all = Vec::new();
        for end in ["\n", "\r\n", "\r"] {
            let text = text.replace('\n', end);
            all.push(text.clone().into_bytes());
            all.push([b"\xef\xbb\xbf", text.as_bytes()].concat());
            all.push([0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect());
            all.push([0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_be_bytes).collect());
        }
        all
    }

    #[test]
    fn every_encoding_and_line_end_gives_the_same_text() {
        let text = "one\n\ntwo \u{1f4a1} \u{fc}\n";
        for bytes in spellings(text) {
            assert_eq!(decode(&bytes).unwrap(), text, "{bytes:x?}");
            assert_eq!(decode_any(&bytes).unwrap(), (text.into(), None), "{bytes:x?}");
        }
        assert_eq!(decode(b"a\rb\r\n\nc\r").unwrap(), "a\nb\n\nc\n");
        assert_eq!(decode(b"").unwrap(), "");
        assert_eq!(decode(b"{}\0\0\0").unwrap(), "{}");
    }

    #[test]
    fn latin_1_is_read_where_it_may_be_and_named_where_not() {
        let bytes = b"a\r\nt\xfcr \xc3\xbc\r\n";
        assert_eq!(decode_any(bytes).unwrap(), ("a\nt\u{fc}r \u{fc}\n".into(), Some(2)));
        assert_eq!(decode(bytes).unwrap_err(), "line 2: is not UTF-8 text, at byte 4");
        assert_eq!(decode(b"\xef\xbb\xbfa\xff").unwrap_err(), "line 1: is not UTF-8 text, at byte 4");
        assert_eq!(decode_any(b"a\rb\r\xff").unwrap().1, Some(3));
    }

    #[test]
    fn what_is_no_text_is_said() {
        for decode in [|bytes| decode(bytes).map(drop), |bytes| decode_any(bytes).map(drop)] {
            let message = |bytes: &'static [u8]| decode(bytes).unwrap_err();
            assert!(message(b"v\nx\0y").starts_with("line 2: holds a NUL byte: "));
            assert!(message(b"{\0}\0").contains("UTF-16 without its byte-order mark"));
            assert!(message(b"\xff\xfea").contains("ends within a character"));
            assert!(message(b"\xff\xfe\0\xd8a\0").starts_with("is not UTF-16 text as its mark says: "));
            assert!(message(b"\xff\xfe\0\0a\0\0\0").starts_with("is UTF-32 text"));
        }
    }
}
