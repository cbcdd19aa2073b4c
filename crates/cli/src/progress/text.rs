//! Numbers as people read them.

use std::time::Duration;

/// The time that is left, when the rest goes as fast as what is done; `None` while that is a guess.
pub(super) fn remaining(elapsed: Duration, fraction: f64) -> Option<Duration> {
    /// Less done than this tells nothing about the rest.
    const ENOUGH: f64 = 0.01;
    if fraction < ENOUGH {
        return None;
    }
    Duration::try_from_secs_f64(elapsed.as_secs_f64() * (1.0 - fraction.min(1.0)) / fraction).ok()
}

/// `h:mm:ss`, or `m:ss` below an hour.
pub(super) fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

/// `mm:ss.ss`, with hours before where there are any.
pub(super) fn clock_hundredths(time: Duration) -> String {
    let hundredths = time.as_millis() / 10;
    let (hours, minutes) = (hundredths / 360_000, hundredths / 6000 % 60);
    let seconds = format!("{minutes:02}:{:02}.{:02}", hundredths / 100 % 60, hundredths % 100);
    if hours > 0 { format!("{hours}:{seconds}") } else { seconds }
}

/// A number of `unit` with three digits or so: `12.3 Mrays`.
pub(crate) fn thousands(value: f64, unit: &str) -> String {
    let (value, prefix) = scaled(value, 1000.0, &["", "k", "M", "G", "T"]);
    format!("{value} {prefix}{unit}")
}

/// Bytes in units of 1024: `1.2 GiB`.
pub(crate) fn bytes(value: u64) -> String {
    let (value, unit) = scaled(value as f64, 1024.0, &["B", "KiB", "MiB", "GiB", "TiB"]);
    format!("{value} {unit}")
}

fn scaled<'a>(mut value: f64, base: f64, units: &[&'a str]) -> (String, &'a str) {
    let mut unit = 0;
    // What rounds to the next unit belongs to it.
    while value.round() >= base && unit + 1 < units.len() {
        value /= base;
        unit += 1;
    }
    let decimals = usize::from(unit > 0 && value < 99.95);
    (format!("{value:.decimals$}"), units[unit])
}

/// A file name without the control characters that would break a line or paint the terminal.
pub(crate) fn clean(name: &str) -> String {
    name.chars().flat_map(|c| if c.is_control() { c.escape_default().collect() } else { vec![c] }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remaining_time_is_in_proportion() {
        let minute = Duration::from_secs(60);
        assert_eq!(remaining(minute, 0.25), Some(Duration::from_secs(180)));
        assert_eq!(remaining(minute, 1.0), Some(Duration::ZERO));
        assert_eq!(remaining(minute, 0.0), None);
    }

    #[test]
    fn clocks() {
        assert_eq!(clock(Duration::from_secs(65)), "1:05");
        assert_eq!(clock(Duration::from_secs(3600 * 12 + 61)), "12:01:01");
        assert_eq!(clock_hundredths(Duration::from_millis(62_349)), "01:02.34");
        assert_eq!(clock_hundredths(Duration::from_secs(7325)), "2:02:05.00");
    }

    #[test]
    fn units() {
        assert_eq!(thousands(0.0, "rays"), "0 rays");
        assert_eq!(thousands(999.4, "rays"), "999 rays");
        assert_eq!(thousands(999.6, "rays"), "1.0 krays");
        assert_eq!(thousands(12_345_678.0, "rays"), "12.3 Mrays");
        assert_eq!(thousands(123_456_789.0, "rays"), "123 Mrays");
        assert_eq!(bytes(0), "0 B");
        assert_eq!(bytes(1536), "1.5 KiB");
        assert_eq!(bytes(5 << 30), "5.0 GiB");
    }

    #[test]
    fn names_stay_on_one_line() {
        assert_eq!(clean("a\nb\u{1b}[0m ö"), "a\\nb\\u{1b}[0m ö");
    }
}
