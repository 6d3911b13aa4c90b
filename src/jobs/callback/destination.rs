//! The URL of a callback, and why it may be refused.

use url::Url;

use crate::wire::ErrorCode;

/// The longest URL of a callback. All receivers and proxies accept this length.
const MAX_URL_BYTES: usize = 2_000;

/// The URL of a callback. It satisfies every rule that can be checked without resolving its host.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CallbackUrl(Url);

/// Why a callback is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CallbackFault {
    /// The URL is too long.
    #[error("a callback's URL has at most {MAX_URL_BYTES} bytes")]
    TooLong,
    /// Not a URL.
    #[error("not a URL: {0}")]
    NotAUrl(url::ParseError),
    /// Neither http nor https.
    #[error("a callback goes by http or https")]
    Scheme,
    /// User or password in the URL, which would end up in logs on the way.
    #[error("a callback's URL holds no name and no password")]
    UserInfo,
    /// A fragment, which is never sent to a receiver.
    #[error("a callback's URL has no fragment")]
    Fragment,
    /// Callbacks are off.
    #[error("this service makes no callbacks")]
    Off,
    /// The host is not listed.
    #[error("'{0}' is not among the hosts that this service may call back")]
    NotListed(String),
    /// The host is listed by name, but resolves to an address that may not be called.
    #[error("'{0}' resolves to an address that is neither public nor listed")]
    NotPublic(String),
}

impl CallbackFault {
    /// Its error code.
    pub fn code(&self) -> ErrorCode {
        match self {
            Self::TooLong => ErrorCode::OutOfRange,
            Self::NotAUrl(_) | Self::Scheme | Self::UserInfo | Self::Fragment => ErrorCode::BadCallbackUrl,
            Self::Off | Self::NotListed(_) | Self::NotPublic(_) => ErrorCode::CallbackNotAllowed,
        }
    }
}

impl CallbackUrl {
    /// A URL fit for callbacks, before the allow list is asked.
    pub(super) fn parse(text: &str) -> Result<Self, CallbackFault> {
        if text.len() > MAX_URL_BYTES {
            return Err(CallbackFault::TooLong);
        }
        let url = Url::parse(text).map_err(CallbackFault::NotAUrl)?;
        if !["http", "https"].contains(&url.scheme()) {
            return Err(CallbackFault::Scheme);
        }
        if !url.username().is_empty() || url.password().is_some() {
            return Err(CallbackFault::UserInfo);
        }
        if url.fragment().is_some() {
            return Err(CallbackFault::Fragment);
        }
        // The URL is parsed again when it is due, and escaping may have made it longer.
        if url.as_str().len() > MAX_URL_BYTES { Err(CallbackFault::TooLong) } else { Ok(Self(url)) }
    }

    /// In its canonical form: `http://0x7f.1/` is `http://127.0.0.1/`.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }

    pub(super) fn url(&self) -> &Url {
        &self.0
    }

    pub(super) fn host(&self) -> &str {
        self.0.host_str().unwrap_or_default()
    }

    /// The receiver: host and port.
    pub(super) fn receiver(&self) -> String {
        let port = self.0.port_or_known_default().unwrap_or_default();
        format!("{}:{port}", self.host())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_of_a_callback_url_has_its_code() {
        let letters = format!("http://erp.example.com/{}", "é".repeat(MAX_URL_BYTES / 3));
        let long = format!("http://erp.example.com/{}", "x".repeat(MAX_URL_BYTES));
        let table = [
            (long.as_str(), CallbackFault::TooLong, ErrorCode::OutOfRange),
            (letters.as_str(), CallbackFault::TooLong, ErrorCode::OutOfRange),
            (
                "erp.example.com",
                CallbackFault::NotAUrl(url::ParseError::RelativeUrlWithoutBase),
                ErrorCode::BadCallbackUrl,
            ),
            ("http://", CallbackFault::NotAUrl(url::ParseError::EmptyHost), ErrorCode::BadCallbackUrl),
            ("ftp://erp.example.com/", CallbackFault::Scheme, ErrorCode::BadCallbackUrl),
            ("file:///etc/passwd", CallbackFault::Scheme, ErrorCode::BadCallbackUrl),
            ("http://me@erp.example.com/", CallbackFault::UserInfo, ErrorCode::BadCallbackUrl),
            ("http://:word@erp.example.com/", CallbackFault::UserInfo, ErrorCode::BadCallbackUrl),
            ("http://erp.example.com/#top", CallbackFault::Fragment, ErrorCode::BadCallbackUrl),
        ];
        for (url, fault, code) in table {
            assert_eq!((CallbackUrl::parse(url).unwrap_err(), fault.code()), (fault, code), "{url}");
        }
        let longest = &long[..MAX_URL_BYTES];
        assert_eq!(CallbackUrl::parse(longest).unwrap().as_str(), longest);
    }

    #[test]
    fn every_refusal_by_the_allow_list_has_the_same_code() {
        let host = "erp.example.com".to_owned();
        for fault in [CallbackFault::Off, CallbackFault::NotListed(host.clone()), CallbackFault::NotPublic(host)] {
            assert_eq!(fault.code(), ErrorCode::CallbackNotAllowed);
        }
    }

    #[test]
    fn a_receiver_is_its_host_and_port() {
        let table = [("http://a/x", "a:80"), ("https://A./", "a.:443"), ("http://[::1]:9/", "[::1]:9")];
        for (url, receiver) in table {
            assert_eq!(CallbackUrl::parse(url).unwrap().receiver(), receiver);
        }
    }
}
