//! Tells public IP addresses from special ones.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr};

use ipnet::{Ipv4Net, Ipv6Net};

/// IPv4 that is not public, after IANA's registry of special addresses.
const SPECIAL_V4: [Ipv4Net; 17] = [
    v4([0, 0, 0, 0], 8),          // "this network"; Linux takes 0.0.0.0 for itself
    v4([10, 0, 0, 0], 8),         // private
    v4([100, 64, 0, 0], 10),      // carrier-grade NAT
    v4([127, 0, 0, 0], 8),        // loopback
    v4([168, 63, 129, 16], 32),   // a cloud's host agent, reachable only from its machines
    v4([169, 254, 0, 0], 16),     // link-local; clouds serve credentials there
    v4([172, 16, 0, 0], 12),      // private
    v4([192, 0, 0, 0], 24),       // protocol assignments
    v4([192, 0, 2, 0], 24),       // documentation
    v4([192, 88, 99, 0], 24),     // 6to4 relays
    v4([192, 168, 0, 0], 16),     // private
    v4([198, 18, 0, 0], 15),      // benchmarking
    v4([198, 51, 100, 0], 24),    // documentation
    v4([203, 0, 113, 0], 24),     // documentation
    v4([224, 0, 0, 0], 4),        // multicast
    v4([240, 0, 0, 0], 4),        // reserved
    v4([255, 255, 255, 255], 32), // broadcast
];

/// The range of public IPv6. Loopback, link-local, unique-local, multicast, discard, mapped and compatible IPv4 and the
/// local translation prefix lie outside.
const GLOBAL_V6: Ipv6Net = v6([0x2000, 0], 3);
/// Special addresses within it.
const SPECIAL_V6: [Ipv6Net; 3] = [
    v6([0x2001, 0], 23),     // protocol assignments: Teredo, benchmarking, ORCHID
    v6([0x2001, 0xdb8], 32), // documentation
    v6([0x3fff, 0], 20),     // documentation
];
/// 6to4: the IPv4 address of the relay follows this prefix.
const SIX_TO_FOUR: Ipv6Net = v6([0x2002, 0], 16);
/// NAT64: the IPv4 address of the destination stands at the end.
const NAT64: Ipv6Net = v6([0x64, 0xff9b], 96);

const fn v4([a, b, c, d]: [u8; 4], bits: u8) -> Ipv4Net {
    Ipv4Net::new_assert(Ipv4Addr::new(a, b, c, d), bits)
}

const fn v6([a, b]: [u16; 2], bits: u8) -> Ipv6Net {
    Ipv6Net::new_assert(Ipv6Addr::new(a, b, 0, 0, 0, 0, 0, 0), bits)
}

/// True if the address is on the public internet and embeds no IPv4 address that is not.
pub(super) fn is_public(address: IpAddr) -> bool {
    match address.to_canonical() {
        IpAddr::V4(address) => is_public_v4(address),
        IpAddr::V6(address) => {
            let [_, a, b, .., c, d] = address.segments();
            if NAT64.contains(&address) {
                return is_public_v4(from_halves(c, d));
            }
            let relayed = SIX_TO_FOUR.contains(&address).then(|| from_halves(a, b));
            GLOBAL_V6.contains(&address)
                && SPECIAL_V6.iter().all(|range| !range.contains(&address))
                && relayed.is_none_or(is_public_v4)
        }
    }
}

fn is_public_v4(address: Ipv4Addr) -> bool {
    SPECIAL_V4.iter().all(|range| !range.contains(&address))
}

fn from_halves(high: u16, low: u16) -> Ipv4Addr {
    Ipv4Addr::from(u32::from(high) << 16 | u32::from(low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_and_last_address_of_each_special_range_is_not_public_and_those_beside_it_are() {
        let ranges = [
            ("0.0.0.0", "0.255.255.255", None, Some("1.0.0.0")),
            ("10.0.0.0", "10.255.255.255", Some("9.255.255.255"), Some("11.0.0.0")),
            ("100.64.0.0", "100.127.255.255", Some("100.63.255.255"), Some("100.128.0.0")),
            ("127.0.0.0", "127.255.255.255", Some("126.255.255.255"), Some("128.0.0.0")),
            ("168.63.129.16", "168.63.129.16", Some("168.63.129.15"), Some("168.63.129.17")),
            ("169.254.0.0", "169.254.255.255", Some("169.253.255.255"), Some("169.255.0.0")),
            ("172.16.0.0", "172.31.255.255", Some("172.15.255.255"), Some("172.32.0.0")),
            ("192.0.0.0", "192.0.0.255", Some("191.255.255.255"), Some("192.0.1.0")),
            ("192.0.2.0", "192.0.2.255", Some("192.0.1.255"), Some("192.0.3.0")),
            ("192.88.99.0", "192.88.99.255", Some("192.88.98.255"), Some("192.88.100.0")),
            ("192.168.0.0", "192.168.255.255", Some("192.167.255.255"), Some("192.169.0.0")),
            ("198.18.0.0", "198.19.255.255", Some("198.17.255.255"), Some("198.20.0.0")),
            ("198.51.100.0", "198.51.100.255", Some("198.51.99.255"), Some("198.51.101.0")),
            ("203.0.113.0", "203.0.113.255", Some("203.0.112.255"), Some("203.0.114.0")),
            ("224.0.0.0", "239.255.255.255", Some("223.255.255.255"), None),
            ("240.0.0.0", "255.255.255.255", None, None),
            ("::", "1fff:ffff:ffff:ffff:ffff:ffff:ffff:ffff", None, Some("2000::")),
            ("2001::", "2001:1ff:ffff:ffff:ffff:ffff:ffff:ffff", Some("2000:ffff::"), Some("2001:200::")),
            ("2001:db8::", "2001:db8:ffff:ffff:ffff:ffff:ffff:ffff", Some("2001:db7::"), Some("2001:db9::")),
            ("3fff::", "3fff:fff:ffff:ffff:ffff:ffff:ffff:ffff", Some("3ffe:ffff::"), Some("3fff:1000::")),
            ("4000::", "ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff", Some("3fff:ffff::"), None),
        ];
        for (first, last, before, after) in ranges {
            let public = |text: &str| is_public(text.parse().unwrap());
            assert!(!public(first) && !public(last), "{first} to {last}");
            assert!(before.is_none_or(public) && after.is_none_or(public), "beside {first} to {last}");
        }
    }

    #[test]
    fn an_embedded_address_decides_whether_its_holder_is_public() {
        let holders: [fn(u16, u16) -> String; 3] = [
            |high, low| format!("::ffff:{high:x}:{low:x}"),
            |high, low| format!("64:ff9b::{high:x}:{low:x}"),
            |high, low| format!("2002:{high:x}:{low:x}::1"),
        ];
        for holder in holders {
            for (high, low, public) in
                [(0x0808, 0x0808, true), (0x7f00, 1, false), (0x0a00, 5, false), (0xa9fe, 0xa9fe, false)]
            {
                let text = holder(high, low);
                assert_eq!(is_public(text.parse().unwrap()), public, "{text}");
            }
        }
    }

    #[test]
    fn tunnel_and_local_addresses_are_not_public() {
        // Compatible, Teredo, NAT64 for local use, the discard prefix, link-local, unique-local, multicast.
        let texts = ["::8.8.8.8", "2001:0:808:808::f7f7:f7f7", "64:ff9b:1::808:808", "100::1", "fe80::1", "fec0::1"];
        for text in texts.into_iter().chain(["fc00::1", "fd00:ec2::254", "ff02::1", "::1", "::"]) {
            assert!(!is_public(text.parse().unwrap()), "{text}");
        }
    }
}
