//! How a light fades with distance (Gelderen appendix A, Tegelaers section 3.1).

use crate::lights::{Attenuation, Light};

/// The attenuation a(d) of `light` at `distance` metres: its tint is multiplied by it.
///
/// Nearer than R0 it is that at R0; at R1 and beyond it is 0, and it is nowhere below 0 where an R1 of the light's
/// own reaches past sqrt(I/I0).
pub fn attenuation(function: Attenuation, light: &Light, distance: f64) -> f64 {
    let [i, i0, r0, r1] = [light.intensity, light.cutoff, light.r0, light.r1].map(f64::from);
    if distance >= r1 {
        return 0.0;
    }
    let d = distance.max(r0).min(r1);
    let physical = i / (d * d);
    let part = d / r1;
    let value = match function {
        Attenuation::Phy => physical,
        Attenuation::Red => physical - i0,
        Attenuation::Smo => physical + 2.0 * i0 * part - 3.0 * i0,
        Attenuation::PhyRed1 => physical - i0 * part,
        Attenuation::PhyRed2 => physical - i0 * part.powi(2),
        Attenuation::PhySmo1 => physical + 2.0 * i0 * part.powi(2) - 3.0 * i0 * part,
        Attenuation::PhySmo2 => physical + 2.0 * i0 * part.powi(3) - 3.0 * i0 * part.powi(2),
        Attenuation::Lin => i * (r1 - d) / r1,
        Attenuation::Stp => i,
        Attenuation::Tegelaers => (1.0 - part).powi(2),
    };
    value.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Attenuation::*;

    /// R1 = sqrt(8/0.5) = 4.
    const LIGHT: Light = Light {
        position: [0.0; 3],
        tint: [1.0; 3],
        intensity: 8.0,
        cutoff: 0.5,
        r0: 0.5,
        r1: 4.0,
        spot: None,
    };

    #[test]
    fn every_function_has_its_value_at_half_the_radius() {
        let values = Attenuation::ALL.map(|function| attenuation(function, &LIGHT, 2.0));
        assert_eq!(values, [2.0, 1.5, 1.0, 1.75, 1.875, 1.5, 1.75, 4.0, 8.0, 0.25]);
    }

    #[test]
    fn it_is_flat_up_to_r0_and_nothing_from_r1_on() {
        for function in Attenuation::ALL {
            assert_eq!(attenuation(function, &LIGHT, 0.0), attenuation(function, &LIGHT, 0.5));
            assert_eq!(attenuation(function, &LIGHT, 4.0), 0.0);
            assert_eq!(attenuation(function, &LIGHT, 9.0), 0.0);
        }
    }

    #[test]
    fn all_but_the_two_with_an_edge_fade_to_nothing() {
        for function in [Red, Smo, PhyRed1, PhyRed2, PhySmo1, PhySmo2, Lin, Tegelaers] {
            assert!(attenuation(function, &LIGHT, 4.0 - 1e-9).abs() < 1e-7, "{function:?}");
        }
        for function in [Smo, Tegelaers] {
            let slope = attenuation(function, &LIGHT, 4.0 - 1e-4) / 1e-4;
            assert!(slope.abs() < 1e-3, "{function:?} ends without a kink");
        }
    }

    #[test]
    fn a_reach_beyond_the_cutoff_takes_no_light_away() {
        let wide = Light { r1: 8.0, ..LIGHT };
        for function in Attenuation::ALL {
            for distance in [0.5, 3.9, 4.1, 6.0, 7.9] {
                assert!(attenuation(function, &wide, distance) >= 0.0, "{function:?} at {distance} m");
            }
        }
        assert_eq!(attenuation(Red, &wide, 6.0), 0.0);
    }

    #[test]
    fn a_near_radius_beyond_the_reach_does_no_harm() {
        let odd = Light { r0: 9.0, ..LIGHT };
        assert_eq!(attenuation(Phy, &odd, 1.0), 0.5);
    }
}
