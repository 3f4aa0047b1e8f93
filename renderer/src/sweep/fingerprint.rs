//! What a run's results depend on, in one hash.

use crate::Result;
use crate::config::{Bearing, Config, Runs};
use crate::inputs::Inputs;
use crate::output::{DeviceInfo, RUN_FORMAT, git_revision};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// What all runs of one scene share of what their results depend on.
pub struct Fingerprint {
    shared: Value,
}

/// Settings that matter only where times decide how many temporal runs are made.
const OF_AUTO: [&str; 2] = ["precision", "max_runs"];

impl Fingerprint {
    /// Takes the content of scene, recording, static lights and shaders, the program, and the device.
    pub fn new(inputs: &Inputs, device: &DeviceInfo, shaders: &str) -> Self {
        let shared = json!({
            "format": RUN_FORMAT,
            "version": env!("CARGO_PKG_VERSION"),
            "git_revision": git_revision(),
            "scene": inputs.scene.sha256,
            "recording": inputs.recording.sha256(),
            "lights_file": inputs.lights_sha256.as_deref().unwrap_or_default(),
            "shaders": shaders,
            "device": device,
        });
        Self { shared }
    }

    /// The fingerprint of the run that `config` makes and no other: hexadecimal SHA-256.
    ///
    /// # Errors
    /// The configuration is not JSON.
    pub fn of(&self, config: &Config) -> Result<String> {
        let matters = |name: &str| config.runs == Runs::Auto || !OF_AUTO.contains(&name);
        let mut config = config.settings(|bearing| bearing != Bearing::Outside)?;
        config.retain(|name, _| matters(name));
        let all = json!({ "shared": self.shared, "config": config });
        Ok(sha256(all.to_string().as_bytes()))
    }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Assign, ExrFrames};
    use crate::lights::{GeneratorKind, LightBox, LightMotion, Lighting};
    use crate::measure::Order;

    #[test]
    fn it_changes_with_what_matters_alone() {
        let of = |device: &str, config: &Config| {
            Fingerprint { shared: json!({ "device": device }) }.of(config).unwrap()
        };
        let base = Config::default();
        let same = of("a", &base);
        assert_eq!(
            of(
                "a",
                &Config { out: "elsewhere".into(), device: Some("0".into()), strict: true, ..base.clone() }
            ),
            same
        );
        assert_ne!(of("b", &base), same);
        assert_eq!(of("a", &Config { precision: 1.0, max_runs: 9, ..base.clone() }), same);
        let auto = Config { runs: Runs::Auto, ..base.clone() };
        assert_ne!(of("a", &Config { precision: 1.0, ..auto.clone() }), of("a", &auto));
        let changed = [
            auto,
            Config { order: Order::Sequential, ..base.clone() },
            Config { runs: 3.into(), ..base.clone() },
            Config { lights: vec![Lighting::with_count(7)], ..base.clone() },
            Config { exr: ExrFrames::All, ..base.clone() },
            Config { resolution: [320, 181], ..base.clone() },
            Config { assign: vec![Assign::Scatter], ..base.clone() },
            Config { test: vec!["exact".parse().unwrap()], ..base.clone() },
        ];
        let gamma = Config { light_source: GeneratorKind::Gamma, ..base.clone() };
        let made = [
            Config { light_seed: Some(2), ..gamma.clone() },
            Config { light_box: Some(LightBox::Rain), ..gamma.clone() },
            Config { light_motion: Some(LightMotion::Bounce), ..gamma.clone() },
            Config { light_motion: Some(LightMotion::Bounce), light_moving: Some(0.5), ..gamma.clone() },
            Config { light_radius_mode: Some(0.5), ..gamma.clone() },
            Config { light_source: GeneratorKind::Volume, ..base.clone() },
        ];
        for config in made {
            assert_ne!(of("a", &config), of("a", &gamma));
        }
        for config in changed {
            assert_ne!(of("a", &config), same);
        }
    }
}
