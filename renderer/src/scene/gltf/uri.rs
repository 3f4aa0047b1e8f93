//! URIs of buffers and images (glTF 2.0, section 2.8).

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

/// Writers disagree on padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Where a URI leads.
#[derive(Debug, PartialEq)]
pub(super) enum Target {
    /// A file, relative to the document's folder.
    File(PathBuf),
    /// Data within the URI itself.
    Data(Vec<u8>),
}

/// Reads a URI: `data:...;base64,...`, `data:...,percent-encoded`, or a percent-encoded path, whose separators may be
/// backslashes.
pub(super) fn resolve(uri: &str) -> Result<Target, String> {
    if let Some(data) = strip_scheme(uri, "data:") {
        return decode_data(data).map(Target::Data);
    }
    if let Some(path) = strip_scheme(uri, "file://") {
        return path_of(path.strip_prefix("localhost").unwrap_or(path)).map(Target::File);
    }
    if uri.contains("://") || strip_scheme(uri, "blob:").is_some() {
        return Err(format!("lies at {uri}; only files and data URIs are read"));
    }
    path_of(uri).map(Target::File)
}

/// What follows `scheme`, whose case does not matter.
fn strip_scheme<'a>(uri: &'a str, scheme: &str) -> Option<&'a str> {
    let (head, rest) = uri.split_at_checked(scheme.len())?;
    head.eq_ignore_ascii_case(scheme).then_some(rest)
}

fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    let (head, body) = data.split_once(',').ok_or("has a data URI without a comma")?;
    let encoding = head.rsplit(';').next().unwrap_or_default().trim();
    let bytes = percent_decode(body);
    if !encoding.eq_ignore_ascii_case("base64") {
        return Ok(bytes);
    }
    // Both alphabets, on one line or wrapped.
    let letter = |byte: u8| match byte {
        b'-' => b'+',
        b'_' => b'/',
        other => other,
    };
    let letters: Vec<u8> = bytes.into_iter().filter(|byte| !byte.is_ascii_whitespace()).map(letter).collect();
    BASE64.decode(letters).map_err(|e| format!("has a broken base64 data URI: {e}"))
}

fn path_of(uri: &str) -> Result<PathBuf, String> {
    let path = String::from_utf8(percent_decode(&uri.replace('\\', "/")));
    path.map(PathBuf::from).map_err(|_| format!("has a URI that is not UTF-8: {uri}"))
}

/// The path of `file` seen from the document at `document`.
pub(super) fn beside(document: &Path, file: &Path) -> PathBuf {
    document.parent().unwrap_or(Path::new("")).join(file)
}

fn percent_decode(text: &str) -> Vec<u8> {
    let mut parts = text.as_bytes().split(|&byte| byte == b'%');
    let mut bytes = parts.next().unwrap_or_default().to_vec();
    for part in parts {
        let digit = |place: usize| part.get(place).and_then(|&byte| char::from(byte).to_digit(16));
        if let (Some(high), Some(low)) = (digit(0), digit(1)) {
            bytes.push((16 * high + low) as u8);
            bytes.extend(&part[2..]);
        } else {
            // A file name with a bare percent sign, as some exporters write it.
            bytes.push(b'%');
            bytes.extend(part);
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_percent_decoded() {
        let file = |uri| resolve(uri).unwrap();
        assert_eq!(file("a%20b/%C3%A9.png"), Target::File("a b/é.png".into()));
        assert_eq!(file("100%.png"), Target::File("100%.png".into()));
        assert!(resolve("%ff").unwrap_err().contains("not UTF-8"));
        assert_eq!(file("tex\\\\wood\\a.png"), Target::File("tex//wood/a.png".into()));
        assert_eq!(file("file:///abs/a%20b.bin"), Target::File("/abs/a b.bin".into()));
        for elsewhere in ["https://example.com/a.png", "HTTP://example.com/a.png", "blob:1-2"] {
            assert!(resolve(elsewhere).unwrap_err().contains(&format!("lies at {elsewhere}")));
        }
    }

    #[test]
    fn data_uris_decode_however_they_are_written() {
        let sound = [
            "data:application/octet-stream;base64,AQL+",
            "data:;base64,AQL-",
            "data:;base64,AQ\n L+",
            "DATA:;charset=utf-8;Base64,AQL%2B",
            "data:application/octet-stream,%01%02%FE",
        ];
        for uri in sound {
            assert_eq!(resolve(uri), Ok(Target::Data(vec![1, 2, 0xfe])), "{uri}");
        }
        assert_eq!(resolve("data:;base64,AQI="), resolve("data:;base64,AQI"));
        for bad in ["data:;base64,!", "data:;base64"] {
            assert!(resolve(bad).is_err(), "{bad}");
        }
    }
}
