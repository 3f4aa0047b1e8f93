//! `run.json`: how a run came to be.

use crate::config::{Config, Lighting};
use crate::measure::{Capacities, GrowthEvent};
use serde::Serialize;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Format and version of `run.json`.
pub const RUN_FORMAT: &str = "manylight.run/1";

/// The git revision that the program was built from, or `unknown`.
pub fn git_revision() -> &'static str {
    env!("MANYLIGHT_GIT_REVISION")
}

/// Everything that made a run what it is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Manifest {
    /// [`RUN_FORMAT`].
    pub format: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// [`git_revision`].
    pub git_revision: &'static str,
    /// Hexadecimal SHA-256 over all that the run's results depend on; a run with the same is not made again.
    pub fingerprint: String,
    /// The method's name.
    pub method: String,
    /// Lighting of the rain; `None` where lights come from a file or the scene.
    pub lighting: Option<Lighting>,
    /// The fully resolved configuration of this run alone; it can be replayed as it is.
    pub config: Config,
    /// How the light lists were built: `brute`, `hierarchy` or `scatter`.
    pub assigned_by: String,
    /// The scene drawn.
    pub scene: Source,
    /// The recording replayed.
    pub recording: Source,
    /// The file of static lights, where they come from one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lights_file: Option<Source>,
    /// Rows of `frames.csv`.
    pub frame_count: usize,
    /// The device that rendered.
    pub device: DeviceInfo,
    /// Buffer capacities at the end of the run.
    pub capacities: Capacities,
    /// Each time that buffers grew.
    pub growth: Vec<GrowthEvent>,
    /// When the run started, RFC 3339, UTC.
    pub started: String,
    /// How long it took, seconds.
    pub duration_s: f64,
}

/// A named input.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Source {
    /// Its name.
    pub name: String,
    /// Hexadecimal SHA-256 of it.
    pub sha256: String,
}

/// The device that rendered.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct DeviceInfo {
    /// Its name.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Version of the Vulkan API it offers.
    pub api: String,
}

/// A moment as RFC 3339 in UTC to the second: `2026-11-05T09:03:07Z`. Moments before 1970 count as its start.
pub fn rfc3339_utc(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO).as_secs();
    let (year, month, day) = civil_date(seconds / 86_400);
    let (hour, minute, second) = (seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Year, month and day of a number of days since 1970-01-01, in the Gregorian calendar.
fn civil_date(days: u64) -> (u64, u64, u64) {
    // Counted from 0000-03-01, leap days end their years, and 400 years are 146097 days.
    let days = days + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    (era * 400 + year_of_era + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rfc_3339() {
        let at = |seconds| rfc3339_utc(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00Z");
        assert_eq!(at(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(at(951_868_799), "2000-02-29T23:59:59Z");
        assert_eq!(at(1_735_689_599), "2024-12-31T23:59:59Z");
        assert_eq!(at(4_107_542_400), "2100-03-01T00:00:00Z");
    }

    #[test]
    fn the_revision_is_a_hash_or_unknown() {
        let revision = git_revision();
        assert!(
            revision == "unknown" || revision.len() >= 40 && revision.bytes().all(|b| b.is_ascii_hexdigit())
        );
    }
}
