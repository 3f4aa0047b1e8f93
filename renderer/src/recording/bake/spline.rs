//! A smooth curve through points at given times.

use glam::DVec3;

/// Cubic Hermite spline through knots (Catmull and Rom 1974, parametrised by the knots' own times): within the
/// curve the tangent at a knot is that of the parabola through it and its neighbours, so velocity is continuous
/// and uneven times make no overshoot of their own; at the ends it is the chord's.
pub(super) struct Spline {
    /// Time and point, times rising; at least one.
    knots: Vec<(f64, DVec3)>,
    /// Velocity at each knot.
    tangents: Vec<DVec3>,
}

impl Spline {
    /// A curve through `knots`, at least one, their times strictly rising.
    pub(super) fn new(knots: Vec<(f64, DVec3)>) -> Self {
        let chord = |k: usize| (knots[k + 1].1 - knots[k].1) / (knots[k + 1].0 - knots[k].0);
        let last = knots.len() - 1;
        let tangents = (0..=last)
            .map(|k| match k {
                _ if last == 0 => DVec3::ZERO,
                0 => chord(0),
                k if k == last => chord(last - 1),
                k => {
                    let (before, after) = (knots[k].0 - knots[k - 1].0, knots[k + 1].0 - knots[k].0);
                    (chord(k - 1) * after + chord(k) * before) / (before + after)
                }
            })
            .collect();
        Self { knots, tangents }
    }

    /// The point at `time`; before the first and after the last knot, that knot's.
    pub(super) fn at(&self, time: f64) -> DVec3 {
        if let [(_, point)] = self.knots[..] {
            return point;
        }
        let next = self.knots.partition_point(|knot| knot.0 <= time).clamp(1, self.knots.len() - 1);
        let ((t0, p0), (t1, p1)) = (self.knots[next - 1], self.knots[next]);
        let (m0, m1) = (self.tangents[next - 1] * (t1 - t0), self.tangents[next] * (t1 - t0));
        let s = ((time - t0) / (t1 - t0)).clamp(0.0, 1.0);
        let r = 1.0 - s;
        p0 * ((1.0 + 2.0 * s) * r * r) + m0 * (s * r * r) + p1 * ((3.0 - 2.0 * s) * s * s) - m1 * (r * s * s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_parabola_is_kept_between_inner_knots() {
        let point = |t: f64| DVec3::new(t, 3.0 - t * t, 2.0 * t * t);
        let spline = Spline::new([0.0, 1.0, 1.5, 4.0, 5.0].map(|t| (t, point(t))).to_vec());
        for t in [1.0, 1.2, 1.5, 2.0, 3.9] {
            assert!((spline.at(t) - point(t)).length() < 1e-12, "{t}");
        }
    }

    #[test]
    fn one_knot_is_a_point() {
        let spline = Spline::new(vec![(2.0, DVec3::ONE)]);
        assert_eq!([1.0, 2.0, 9.0].map(|t| spline.at(t)), [DVec3::ONE; 3]);
    }

    proptest! {
        /// The curve passes through its knots, does not jump there, and neither does its velocity.
        #[test]
        fn knots_are_passed_smoothly(
            steps in prop::collection::vec((0.1_f64..5.0, -9.0_f64..9.0, -9.0_f64..9.0), 2..8)
        ) {
            let mut time = -3.0;
            let knots: Vec<_> = steps.iter().map(|&(step, x, y)| {
                time += step;
                (time, DVec3::new(x, y, x - y))
            }).collect();
            let spline = Spline::new(knots.clone());
            for (index, &(t, point)) in knots.iter().enumerate() {
                prop_assert!((spline.at(t) - point).length() < 1e-9);
                if index > 0 && index + 1 < knots.len() {
                    let h = 1e-6;
                    let (before, after) = (point - spline.at(t - h), spline.at(t + h) - point);
                    prop_assert!((before - after).length() / h < 0.1, "{}", (before - after).length() / h);
                }
            }
        }
    }
}
