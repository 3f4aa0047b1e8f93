//! URIs of buffers and images (glTF 2.0, section 2.8).

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

/// Exporters disagree on padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Where a URI leads.
#[derive(Debug, PartialEq)]
pub(super) enum Target {
    /// A file, relative to the document's folder.
    File(PathBuf),
    /// Bytes within the URI itself.
    Data(Vec<u8>),
}

/// Reads a URI: `data:...;base64,...` or a percent-encoded relative path.
pub(super) fn resolve(uri: &str) -> Result<Target, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (head, body) = data.split_once(',').ok_or("has a data URI without a comma")?;
        if !head.ends_with(";base64") {
            return Err("has a data URI that is not base64".into());
        }
        let bytes = BASE64.decode(body.trim()).map_err(|e| format!("has a broken base64 data URI: {e}"))?;
        return Ok(Target::Data(bytes));
    }
    if uri.contains("://") {
        return Err(format!("lies at {uri}; only files and data URIs are read"));
    }
    Ok(Target::File(PathBuf::from(percent_decode(uri)?)))
}

/// The path of `file` seen from the document at `document`.
pub(super) fn beside(document: &Path, file: &Path) -> PathBuf {
    document.parent().unwrap_or(Path::new("")).join(file)
}

fn percent_decode(text: &str) -> Result<String, String> {
    let mut parts = text.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        let code = part.get(..2).and_then(|hex| u8::from_str_radix(hex, 16).ok());
        match code {
            Some(code) => {
                bytes.push(code);
                bytes.extend(&part.as_bytes()[2..]);
            }
            // A file name with a bare percent sign, as some exporters write it.
            None => bytes.extend([b"%", part.as_bytes()].concat()),
        }
    }
    String::from_utf8(bytes).map_err(|_| format!("has a URI that is not UTF-8: {text}"))
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
        assert!(resolve("https://example.com/a.png").unwrap_err().contains("https://example.com"));
    }

    #[test]
    fn data_uris_decode_with_and_without_padding() {
        for uri in ["data:application/octet-stream;base64,AQI=", "data:;base64,AQI"] {
            assert_eq!(resolve(uri), Ok(Target::Data(vec![1, 2])));
        }
        for bad in ["data:;base64,!", "data:text/plain,hi", "data:;base64"] {
            assert!(resolve(bad).is_err(), "{bad}");
        }
    }
}
