//! The allow list of callback receivers.

use core::fmt;
use core::str::FromStr;
use std::net::IpAddr;

use ipnet::IpNet;
use url::Host;

use super::address::is_public;
use super::destination::{CallbackFault, CallbackUrl};

/// The receivers that callbacks may go to: none unless listed.
///
/// A host is listed by its name. The addresses of the name must be public too, unless they are listed themselves: the
/// owner of a name must not choose machines in the operator's network.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CallbackAllow(Vec<AllowedHost>);

#[derive(Debug, Clone, PartialEq, Eq)]
enum AllowedHost {
    /// This name. `localhost` stands for the loopback addresses too.
    Name(String),
    /// Every name that ends in this one and is longer.
    Below(String),
    /// These addresses, written as numbers or behind a name, public or not.
    Range(IpNet),
}

impl CallbackAllow {
    /// True if nothing is listed: callbacks are off.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The URL of a callback, if it is allowed.
    ///
    /// # Errors
    /// [`CallbackFault`]. The addresses of the host are checked at each call.
    pub fn check(&self, text: &str) -> Result<CallbackUrl, CallbackFault> {
        if self.is_empty() {
            return Err(CallbackFault::Off);
        }
        let url = CallbackUrl::parse(text)?;
        let listed = match url.url().host() {
            Some(Host::Domain(name)) => self.0.iter().any(|entry| entry.names(name)),
            Some(Host::Ipv4(address)) => self.lists(address.into()),
            Some(Host::Ipv6(address)) => self.lists(address.into()),
            None => false,
        };
        if listed { Ok(url) } else { Err(CallbackFault::NotListed(url.host().to_owned())) }
    }

    /// Checks the addresses of a listed name. One forbidden address refuses the name: otherwise the destination would
    /// depend on the order in which addresses are tried, and the forbidden ones would go unnoticed.
    ///
    /// # Errors
    /// [`CallbackFault::NotPublic`].
    pub(super) fn check_addresses(&self, name: &str, addresses: &[IpAddr]) -> Result<(), CallbackFault> {
        let allowed = addresses.iter().all(|address| is_public(*address) || self.lists(*address));
        if allowed { Ok(()) } else { Err(CallbackFault::NotPublic(name.to_owned())) }
    }

    fn lists(&self, address: IpAddr) -> bool {
        // An IPv4-mapped address is the same machine.
        let address = address.to_canonical();
        self.0.iter().any(|entry| entry.covers(address))
    }
}

impl AllowedHost {
    fn names(&self, host: &str) -> bool {
        let host = host.strip_suffix('.').unwrap_or(host);
        match self {
            Self::Name(name) => name == host,
            Self::Below(name) => host
                .strip_suffix(name.as_str())
                .and_then(|rest| rest.strip_suffix('.'))
                .is_some_and(|rest| !rest.is_empty()),
            Self::Range(_) => false,
        }
    }

    fn covers(&self, address: IpAddr) -> bool {
        match self {
            Self::Name(name) => name == "localhost" && address.is_loopback(),
            Self::Below(_) => false,
            Self::Range(range) => range.contains(&address),
        }
    }
}

/// The entry that turns callbacks off.
const NOBODY: &str = "none";

impl FromStr for CallbackAllow {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == NOBODY {
            return Ok(Self::default());
        }
        text.split(',').map(|entry| entry.trim().parse()).collect::<Result<_, _>>().map(Self)
    }
}

impl FromStr for AllowedHost {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let fault = || format!("'{text}' is not a host name, *.name, an address or a range like 10.0.0.0/8");
        let range = text.parse().ok().or_else(|| text.parse().ok().map(|address: IpAddr| IpNet::from(address)));
        if let Some(range) = range {
            // Addresses are compared in their canonical form, so such an entry would never match.
            let mapped = matches!(range, IpNet::V6(range) if range.addr().to_ipv4_mapped().is_some());
            return if mapped { Err(format!("'{text}': write it as IPv4")) } else { Ok(Self::Range(range)) };
        }
        let (name, below) = text.strip_prefix("*.").map_or((text, false), |name| (name, true));
        let name = name.to_ascii_lowercase();
        let sound = |label: &str| {
            let part = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
            label.chars().all(part) && !label.is_empty() && !label.starts_with('-') && !label.ends_with('-')
        };
        // URLs hold such a name, for example 10.1, in another form, so it would never match either.
        let kept = Host::parse(&name).is_ok_and(|host| host == Host::Domain(name.clone()));
        match (kept && name.split('.').all(sound) && name != NOBODY, below) {
            (false, _) => Err(fault()),
            (true, true) => Ok(Self::Below(name)),
            (true, false) => Ok(Self::Name(name)),
        }
    }
}

impl fmt::Display for CallbackAllow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str(NOBODY);
        }
        for (at, entry) in self.0.iter().enumerate() {
            let comma = if at > 0 { "," } else { "" };
            write!(f, "{comma}{entry}")?;
        }
        Ok(())
    }
}

impl fmt::Display for AllowedHost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => f.write_str(name),
            Self::Below(name) => write!(f, "*.{name}"),
            Self::Range(range) if range.prefix_len() == range.max_prefix_len() => range.addr().fmt(f),
            Self::Range(range) => range.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn allow(text: &str) -> CallbackAllow {
        text.parse().unwrap()
    }

    #[test]
    fn an_empty_allow_list_forbids_every_callback() {
        let nobody = CallbackAllow::default();
        assert_eq!(nobody.check("https://erp.example.com/"), Err(CallbackFault::Off));
        assert_eq!((allow("none"), nobody.to_string().as_str()), (nobody, "none"));
    }

    #[test]
    fn a_host_is_listed_by_its_whole_name_by_what_it_ends_in_or_by_its_address() {
        let table = [
            ("erp.example.com", "https://erp.example.com/x?y=z", true),
            ("erp.example.com", "http://ERP.example.COM:8080/", true),
            ("ERP.Example.com", "http://erp.example.com/", true),
            ("erp.example.com", "http://erp.example.com./", true),
            ("erp.example.com", "http://a.erp.example.com/", false),
            ("erp.example.com", "http://erp.example.com.evil.org/", false),
            ("erp.example.com", "http://evil.org/erp.example.com", false),
            ("erp.example.com", "http://evil.org\\erp.example.com", false),
            ("*.example.com", "http://a.example.com/", true),
            ("*.example.com", "http://a.b.example.com/", true),
            ("*.example.com", "http://example.com/", false),
            ("*.example.com", "http://.example.com/", false),
            ("*.example.com", "http://badexample.com/", false),
            ("xn--bcher-kva.example", "http://bücher.example/", true),
            ("erp.example.com, 192.0.2.7", "http://192.0.2.7/", true),
            ("192.0.2.7", "http://192.0.2.8/", false),
            ("10.0.0.0/8", "http://10.9.8.7/", true),
            ("10.0.0.0/8", "http://11.9.8.7/", false),
            ("10.0.0.0/8", "http://[::ffff:10.9.8.7]/", true),
            ("0.0.0.0/0", "http://[2606::1]/", false),
            ("fd00::/8", "http://[fd00::5]:81/", true),
            ("::1", "http://[::1]/", true),
            ("::1", "http://127.0.0.1/", false),
            ("localhost", "http://localhost:9000/", true),
            ("localhost", "http://127.9.9.9/", true),
            ("localhost", "http://[::1]/", true),
            ("localhost", "http://[::ffff:127.0.0.1]/", true),
            ("erp.example.com", "http://93.184.216.34/", false),
            ("erp.example.com", "http://localhost/", false),
        ];
        for (list, url, listed) in table {
            assert_eq!(allow(list).check(url).is_ok(), listed, "{list} for {url}");
        }
    }

    #[test]
    fn every_way_to_write_an_address_is_that_address() {
        for host in ["2130706433", "0x7f.1", "0x7f000001", "017700000001", "127.1", "127.0.0.1.", "１２７.0.0.1"] {
            let url = format!("http://{host}/");
            let fault = CallbackFault::NotListed("127.0.0.1".to_owned());
            assert_eq!(allow("*.example.com,10.0.0.0/8").check(&url), Err(fault), "{host}");
            assert_eq!(allow("127.0.0.0/8").check(&url).unwrap().as_str(), "http://127.0.0.1/", "{host}");
        }
        for host in ["[::ffff:7f00:1]", "[0:0:0:0:0:ffff:127.0.0.1]"] {
            assert!(allow("127.0.0.1").check(&format!("http://{host}/")).is_ok(), "{host}");
        }
    }

    #[test]
    fn a_name_that_leads_to_one_address_that_may_not_be_called_is_refused() {
        let table: [(&str, &[&str], bool); 8] = [
            ("erp.example.com", &["93.184.216.34", "2606::1"], true),
            ("erp.example.com", &["93.184.216.34", "10.0.0.5"], false),
            ("erp.example.com", &["169.254.169.254"], false),
            ("erp.example.com,10.0.0.0/8", &["93.184.216.34", "10.0.0.5"], true),
            ("erp.example.com,10.0.0.0/8", &["::ffff:10.0.0.5"], true),
            ("erp.example.com,10.0.0.0/8", &["64:ff9b::a00:5"], false),
            ("erp.example.com", &["127.0.0.1"], false),
            ("erp.example.com,localhost", &["127.0.0.1", "::1"], true),
        ];
        for (list, addresses, allowed) in table {
            let addresses: Vec<IpAddr> = addresses.iter().map(|text| text.parse().unwrap()).collect();
            let outcome = allow(list).check_addresses("erp.example.com", &addresses);
            assert_eq!(outcome.is_ok(), allowed, "{list} for {addresses:?}");
        }
    }

    #[test]
    fn a_list_is_shown_as_it_can_be_written() {
        let text = "erp.example.com,*.example.org,127.0.0.1,10.0.0.0/8,::1,fd00::/8";
        assert_eq!(allow(text).to_string(), text);
        assert_eq!(allow(" Erp.example.com , ::1/128 ").to_string(), "erp.example.com,::1");
    }

    #[test]
    fn an_entry_that_no_url_could_meet_is_refused() {
        let table =
            ["", "a,,b", "*", "*.", "a.*.b", "http://a", "a:80", "a/b", "bücher.example", "10.1", "0x7f.1", "a b"];
        let more =
            ["::ffff:10.0.0.1", "10.0.0.0/33", "[::1]", ".a", "a.", "-a", "a-", "2130706433", "none,a", "*.10.1"];
        for text in table.into_iter().chain(more) {
            assert!(text.parse::<CallbackAllow>().is_err(), "'{text}'");
        }
    }
}
