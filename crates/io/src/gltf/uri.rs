//! URIs of buffers and images: data inside the JSON, or a file beside it.
//!
//! A relative path counts from the folder of the model and may lead out of it with `..`, as the paths of OBJ files and scene
//! files may: whoever opens a model lets it name files. Addresses of a network are refused.

use super::flaw::Flaw;
use crate::error::quote;
use std::path::{Path, PathBuf};

/// What a URI leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// Bytes that it holds itself.
    Data(Vec<u8>),
    /// A file.
    File(PathBuf),
}

/// Follows a URI of a model in `folder`.
///
/// # Errors
/// When it is damaged or leads to a network.
pub(super) fn resolve(uri: &str, folder: &Path, place: &str) -> Result<Target, Flaw> {
    if let Some(data) = uri.strip_prefix("data:") {
        return data_bytes(data, place).map(Target::Data);
    }
    let plain = uri.strip_prefix("file://").unwrap_or(uri);
    // A single letter before the colon is a drive.
    let scheme = plain.split_once(':').map_or("", |(scheme, _)| scheme);
    let is_scheme =
        scheme.len() > 1 && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    if is_scheme {
        return Err(Flaw::new(place, format!("{} is no file", quote(uri)))
            .with_help("put the file beside the model, and its name into the model"));
    }
    let bytes = percent_decoded(plain.as_bytes());
    match String::from_utf8(bytes) {
        Ok(path) => Ok(Target::File(folder.join(path))),
        Err(_) => Err(Flaw::new(place, format!("{} is not UTF-8", quote(uri))).with_help("rename the file")),
    }
}

/// The bytes of a data URI, `media/type;base64,...`.
fn data_bytes(data: &str, place: &str) -> Result<Vec<u8>, Flaw> {
    let damaged = |why: &str| Flaw::new(place, format!("data URI {why}")).with_help("export the file again");
    let (kind, text) = data.split_once(',').ok_or_else(|| damaged("has no comma"))?;
    if kind.ends_with(";base64") {
        base64(text.as_bytes()).ok_or_else(|| damaged("is not base64"))
    } else {
        Ok(percent_decoded(text.as_bytes()))
    }
}

/// `text` with `%41` as `A`; a per cent sign without two digits stays.
fn percent_decoded(text: &[u8]) -> Vec<u8> {
    let digit = |at: usize| char::from(*text.get(at)?).to_digit(16).map(|digit| digit as u8);
    let mut bytes = Vec::with_capacity(text.len());
    let mut at = 0;
    while at < text.len() {
        match (text[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                bytes.push(16 * high + low);
                at += 3;
            }
            (byte, ..) => {
                bytes.push(byte);
                at += 1;
            }
        }
    }
    bytes
}

/// The bytes that base64 stands for, with or without its padding.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 3);
    let (mut bits, mut count) = (0_u32, 0);
    for &c in text {
        let value = match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            b'=' => break,
            c if c.is_ascii_whitespace() => continue,
            _ => return None,
        };
        bits = bits << 6 | u32::from(value);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn target(uri: &str) -> Target {
        resolve(uri, Path::new("folder"), "buffers[0].uri").unwrap()
    }

    #[test]
    fn data_uris_hold_their_bytes() {
        // RFC 4648, section 10.
        for (text, bytes) in [("Zm9vYmFy", "foobar"), ("Zm9vYg==", "foob"), ("Zm9v\nYmE=", "fooba"), ("", "")]
        {
            let uri = format!("data:application/octet-stream;base64,{text}");
            assert_eq!(target(&uri), Target::Data(bytes.as_bytes().to_vec()));
        }
        assert_eq!(target("data:,a%20b%2"), Target::Data(b"a b%2".to_vec()));
    }

    #[test]
    fn files_lie_in_the_folder() {
        let file = |path: &str| Target::File(Path::new("folder").join(path));
        assert_eq!(target("a%20b.bin"), file("a b.bin"));
        assert_eq!(target("../ma%C3%9F.png"), file("../maß.png"));
        assert_eq!(target("100%.bin"), file("100%.bin"));
    }

    #[test]
    fn what_leads_nowhere_is_refused() {
        for uri in ["https://example.org/a.bin", "data:abc", "data:;base64,!!", "%ff.bin"] {
            assert!(resolve(uri, Path::new(""), "images[0].uri").is_err(), "{uri}");
        }
    }
}
