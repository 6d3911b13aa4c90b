//! Suggestions for mistyped names.

/// The least similarity, where 1 is equality. Below this, names only share some letters.
const ALIKE: f64 = 0.82;

/// The most similar known name, if any is similar enough.
pub(super) fn closest(name: &str, known: impl Iterator<Item = String>) -> Option<String> {
    let scored = known.map(|other| (strsim::jaro_winkler(name, &other), other));
    let alike = scored.filter(|(score, _)| *score >= ALIKE);
    alike.max_by(|(one, _), (other, _)| one.total_cmp(other)).map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::SETTINGS;

    #[test]
    fn a_mistyped_setting_is_known_again_and_another_word_is_not() {
        for (name, meant) in [
            ("tread", Some("threads")),
            ("treads", Some("threads")),
            ("api_key_file", Some("api_keys_file")),
            ("log_level", Some("log")),
            ("job_url", Some("jobs_url")),
            ("tls_certificate", Some("tls_cert")),
            ("max_body_size", Some("max_body_bytes")),
            ("timeout", None),
            ("secret", None),
            ("port", None),
            ("port_8080_tcp", None),
            ("service_host", None),
            ("", None),
        ] {
            let known = SETTINGS.iter().map(|setting| setting.name.to_owned());
            assert_eq!(closest(name, known).as_deref(), meant, "{name}");
        }
    }
}
