//! The signature by which a receiver recognises our callbacks.

use core::fmt;
use core::fmt::Write as _;
use core::str::FromStr;

use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;

/// The header with the time of signing, seconds since 1970. Receivers refuse old ones, which may be replays.
pub(super) const TIMESTAMP_HEADER: &str = "singulate-timestamp";
/// The header with the signature.
pub(super) const SIGNATURE_HEADER: &str = "singulate-signature";

/// The shortest secret: 128 bits, if they are random, are beyond guessing.
const MIN_SECRET_BYTES: usize = 16;

/// The secret shared with the receivers of callbacks. Never displayed.
#[derive(Clone, PartialEq, Eq)]
pub struct CallbackSecret(String);

impl FromStr for CallbackSecret {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.len() < MIN_SECRET_BYTES {
            // Without the text: errors end up in logs.
            return Err(format!("the secret is shorter than {MIN_SECRET_BYTES} bytes"));
        }
        Ok(Self(text.to_owned()))
    }
}

impl fmt::Debug for CallbackSecret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("CallbackSecret(…)")
    }
}

impl CallbackSecret {
    /// The signature of a message: `sha256=` and HMAC-SHA256 of the timestamp, a dot and the body, hexadecimal.
    pub(super) fn sign(&self, timestamp: &str, body: &[u8]) -> String {
        let digest = hmac_sha256(self.0.as_bytes(), &[timestamp.as_bytes(), b".", body]);
        let mut text = "sha256=".to_owned();
        for byte in digest {
            // Writing to a string can't fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}

fn hmac_sha256(key: &[u8], parts: &[&[u8]]) -> [u8; 32] {
    let mut mac = Hmac::<Sha256>::new_from_slice(key).expect("HMAC takes keys of any length");
    parts.iter().for_each(|part| mac.update(part));
    mac.finalize().into_bytes().into()
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;
    use std::process::{Command, Stdio};

    use super::*;

    const PAGE: &str = include_str!("../../../docs/jobs.md");

    fn hex(digest: [u8; 32]) -> String {
        digest.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    #[test]
    fn the_vectors_of_rfc_4231_come_out() {
        let long = [0xaa; 131];
        let last: &[u8] = b"This is a test using a larger than block-size key and a larger than block-size data. \
            The key needs to be hashed before being used by the HMAC algorithm.";
        let counted: Vec<u8> = (1..=25).collect();
        let table: [(&[u8], &[u8], &str); 6] = [
            (&[0x0b; 20], b"Hi There", "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7"),
            (
                b"Jefe",
                b"what do ya want for nothing?",
                "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843",
            ),
            (&[0xaa; 20], &[0xdd; 50], "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe"),
            (&counted, &[0xcd; 50], "82558a389a443c0ea4cc819899f2083a85f0faa3e578f8077a2e3ff46729665b"),
            (
                &long,
                b"Test Using Larger Than Block-Size Key - Hash Key First",
                "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54",
            ),
            (&long, last, "9b09ffa71b942fcb27635fbcd5b0e944bfdc63644f0713938a7f51535c3a35e2"),
        ];
        for (key, data, digest) in table {
            assert_eq!(hex(hmac_sha256(key, &[data])), digest);
        }
    }

    #[test]
    fn a_secret_is_long_and_never_shown() {
        assert!("0123456789abcdef".parse::<CallbackSecret>().is_ok());
        let fault = "0123456789abcde".parse::<CallbackSecret>().unwrap_err();
        assert!(!fault.contains("0123"), "{fault}");
        let secret: CallbackSecret = "0123456789abcdef".parse().unwrap();
        assert!(!format!("{secret:?} {secret:#?}").contains("0123"));
    }

    #[test]
    fn time_and_body_and_secret_all_count() {
        let secret: CallbackSecret = "0123456789abcdef".parse().unwrap();
        let other: CallbackSecret = "0123456789abcdeg".parse().unwrap();
        let signature = secret.sign("1", b"2.{}");
        assert!(signature.starts_with("sha256=") && signature.len() == 7 + 64);
        for different in [secret.sign("2", b"2.{}"), secret.sign("1", b"2.{ }"), other.sign("1", b"2.{}")] {
            assert_ne!(different, signature);
        }
    }

    /// Runs the documented check on a message; true if it passes.
    fn documented_receiver_takes(headers: &str, body: &str) -> bool {
        let (_, rest) = PAGE.split_once("```python\n").unwrap();
        let example = rest.split_once("```").unwrap().0;
        let script = format!("{example}\nprint(is_ours({headers}, b'{body}', b'0123456789abcdef'))\n");
        let python = Command::new("python3").arg("-").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut python = python.expect("the example of a receiver in docs/jobs.md needs python3");
        python.stdin.take().unwrap().write_all(script.as_bytes()).unwrap();
        let output = python.wait_with_output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap().trim() == "True"
    }

    #[test]
    fn the_documented_receiver_takes_our_messages_and_no_others() {
        let secret: CallbackSecret = "0123456789abcdef".parse().unwrap();
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_secs();
        let headers =
            |at: u64, signature: &str| format!("{{'{TIMESTAMP_HEADER}': '{at}', '{SIGNATURE_HEADER}': '{signature}'}}");
        let signed = |at: u64| secret.sign(&at.to_string(), b"{}");
        assert!(documented_receiver_takes(&headers(now, &signed(now)), "{}"));
        assert!(!documented_receiver_takes(&headers(now, &signed(now)), "{ }"));
        assert!(!documented_receiver_takes(&headers(now, &signed(now - 1)), "{}"));
        assert!(!documented_receiver_takes(&headers(now - 3600, &signed(now - 3600)), "{}"));
    }
}
