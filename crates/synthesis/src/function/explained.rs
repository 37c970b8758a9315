//! Function generation as a problem, and the formulas of its proof: Chebyshev's spacing,
//! Freudenstein's equation with its numbers.

use super::{Function, FunctionTarget};
use crate::candidate::Draft;
use crate::statement::{angle, length, number, of, subtracted};
use crate::{Proof, Statement};
use hodograph_base::diag::{Both, both};
use hodograph_base::lang::each;

/// Greatest number of pairs in the list of givens, and of equations in a proof; of more, the first
/// are printed.
const TOLD: usize = 12;
const EQUATIONS: usize = 5;

impl Function {
    pub(super) fn stated(&self) -> Statement {
        let mut given = Vec::new();
        let task = match &self.target {
            FunctionTarget::Curve { text, range, swings, places, .. } => {
                given.push(both!(
                    "function $y$ = {text}, $x$ from ${}$ to ${}$",
                    number(range[0]),
                    number(range[1])
                ));
                given.push(match self.minimax {
                    true => both!("the greatest structural error is to be as small as possible"),
                    false => both!("${}$ precision points in Chebyshev's spacing", places.len()),
                });
                let [input, output] = *swings;
                given.push(both!("swing of the crank $\\alpha_m = {}$", angle(input)));
                given.push(both!("swing of the follower $\\varphi_m = {}$", angle(output)));
                both!(
                    "Design a four-bar $ABCD$ that makes a function: the turning $\\alpha$ of the crank $AB$ stands for $x$, the turning $\\varphi$ of the follower $DC$ for $y$."
                )
            }
            FunctionTarget::Pairs { .. } => {
                for (k, s) in self.steps.iter().take(TOLD).enumerate() {
                    let at = [0, 1].map(|i| angle(s[i] + self.start[i].unwrap_or(0.0)));
                    given.push(both!(
                        "$\\alpha_{{{0}}} = {1}$, $\\varphi_{{{0}}} = {2}$",
                        k + 1,
                        at[0],
                        at[1]
                    ));
                }
                if self.steps.len() > TOLD {
                    given.push(both!("and {} pairs more, as in the file", self.steps.len() - TOLD));
                }
                both!(
                    "Design a four-bar $ABCD$ whose two cranks $AB$ and $DC$ take these corresponding positions."
                )
            }
        };
        given.extend(self.frame.map(|l| both!("frame $l_{{AD}} = {}$", length(l))));
        given.extend(self.crank.map(|l| both!("crank $l_{{AB}} = {}$", length(l))));
        let mut wanted = vec![match self.crank {
            Some(_) => {
                both!("the lengths $l_{{BC}}$ (coupler) and $l_{{CD}}$ (follower)")
            }
            None => crate::statement::four_bar_wanted(),
        }];
        for (i, start, names) in
            [(0, "\\alpha_0", each!("crank")), (1, "\\varphi_0", each!("angle" => "follower"))]
        {
            let link = Both::from(names);
            match self.start[i] {
                Some(at) if matches!(self.target, FunctionTarget::Curve { .. }) => {
                    given.push(both!("starting angle of the {} ${start} = {}$", link, angle(at)));
                }
                Some(_) => {}
                None => wanted.push(both!("the starting angle ${start}$ of the {}", link)),
            }
        }
        Statement {
            task,
            given,
            wanted,
            open_steps: usize::from(self.crank.is_some() && self.frame.is_some()),
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let mut out = Vec::new();
        if let FunctionTarget::Curve { places, range, swings, values, .. } = &self.target {
            out.push(scales(*range, *values, *swings));
            let n = places.len();
            let spaced = format!(
                "x_k = \\frac{{{a} + {b}}}{{2}} − \\frac{{{b} − {a}}}{{2}}\\cos\\frac{{(2k − 1)180\\degree}}{{{}}}",
                2 * n,
                a = number(range[0]),
                b = number(range[1])
            );
            let told: Vec<String> = places
                .iter()
                .take(TOLD)
                .enumerate()
                .map(|(k, x)| format!("x_{{{}}} = {}", k + 1, number(*x)))
                .collect();
            let rows = told.chunks(4).map(|c| c.join(" ,\\quad "));
            out.push(Proof::new(self.spacing(), std::iter::once(spaced).chain(rows)));
        }
        let starts = [of(draft, "alpha0"), of(draft, "phi0")];
        let at = |k: usize| [0, 1].map(|i| starts[i] + self.steps[k][i]);
        let turned =
            |i: usize| if of(draft, ["K1", "K2"][i]) < 0.0 { std::f64::consts::PI } else { 0.0 };
        let equation = |k: usize| {
            // K belongs to the arms as the equations give them: a reversed arm counts from the
            // opposite direction.
            let [alpha, phi] = at(k);
            let (alpha, phi) = (alpha - turned(0), phi - turned(1));
            let near = |v: f64| libm::atan2(libm::sin(v), libm::cos(v));
            format!(
                "{}\\,K_1 {}\\,K_2 + K_3 = {}",
                number(libm::cos(phi)),
                subtracted(libm::cos(alpha)),
                number(libm::cos(near(alpha - phi)))
            )
        };
        let [crank, follower, between] = self.angles();
        let mut formulas =
            vec![format!("K_1\\cos{follower} − K_2\\cos{crank} + K_3 = \\cos{between}")];
        formulas.push(
            "K_1 = \\frac{l_{AD}}{l_{AB}} ,\\quad K_2 = \\frac{l_{AD}}{l_{CD}} ,\\quad K_3 = \\frac{l_{AB}^2 − l_{BC}^2 + l_{CD}^2 + l_{AD}^2}{2\\,l_{AB}\\,l_{CD}}".to_owned(),
        );
        out.push(Proof::new(
            both!(
                "Closing the quadrilateral and taking $BC$ out of the equations gives Freudenstein's equation:"
            ),
            formulas,
        ));
        out.push(Proof::new(
            both!(
                "Divided by $K_2$, with the lengths in units of the crank, it is the form of Chinese course books, with $P_0 = K_1/K_2$, $P_1 = −1/K_2$, $P_2 = K_3/K_2$:"
            ),
            [format!("\\cos{crank} = P_0\\cos{follower} + P_1\\cos{between} + P_2")],
        ));
        let exact = draft.error == 0.0;
        let count = self.steps.len().min(EQUATIONS);
        out.push(Proof::new(
            self.how(exact),
            if exact { (0..count).map(equation).collect::<Vec<_>>() } else { Vec::new() },
        ));
        let k = ["K1", "K2", "K3"].map(|n| number(of(draft, n)));
        let mut results =
            vec![format!("K_1 = {} ,\\quad K_2 = {} ,\\quad K_3 = {}", k[0], k[1], k[2])];
        let p = ["P0", "P1", "P2"].map(|n| number(of(draft, n)));
        results.push(
            "P_0 = m ,\\quad P_1 = −\\frac{m}{n} ,\\quad P_2 = \\frac{m^2 + n^2 + 1 − l^2}{2\\,n}"
                .to_owned(),
        );
        results.push(format!("P_0 = {} ,\\quad P_1 = {} ,\\quad P_2 = {}", p[0], p[1], p[2]));
        let ratio = |name, of_arm: &str, value: &str| {
            format!("{name} = \\frac{{l_{{{of_arm}}}}}{{l_{{AB}}}} = {value}")
        };
        let [m, n, l] = ["m", "n", "l"].map(|n| number(of(draft, n)));
        let ratios = [ratio("m", "CD", &m), ratio("n", "AD", &n), ratio("l", "BC", &l)];
        results.push(ratios.join(" ,\\quad "));
        results.push(format!(
            "\\alpha_0 = {} ,\\quad \\varphi_0 = {}",
            angle(starts[0]),
            angle(starts[1])
        ));
        let l = ["AB", "BC", "CD", "AD"].map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))));
        results.push(l.join(" ,\\quad "));
        out.push(Proof::new(both!("solved" => "So"), results));
        out
    }

    /// Returns the angles of crank and follower from the frame and their difference, in brackets
    /// where they have several terms: turns count from the starting angles.
    fn angles(&self) -> [String; 3] {
        let counted = |i: usize| {
            matches!(self.target, FunctionTarget::Curve { .. }) || self.start[i].is_none()
        };
        let of = |i: usize, turn: &str| match counted(i) {
            true => (
                format!("({turn}_0 + {turn})"),
                [format!("{turn}_0 + {turn}"), format!("{turn}_0 − {turn}")],
            ),
            false => (turn.to_owned(), [turn.to_owned(), turn.to_owned()]),
        };
        let (crank, [plus, _]) = of(0, "\\alpha");
        let (follower, [_, minus]) = of(1, "\\varphi");
        [crank, follower, format!("({plus} − {minus})")]
    }

    fn spacing(&self) -> Both {
        match self.minimax {
            true => {
                both!("The exchange begins from the five precision points in Chebyshev's spacing:")
            }
            false => {
                both!("Precision points in Chebyshev's spacing:")
            }
        }
    }

    /// The method by which the constants are found.
    fn how(&self, exact: bool) -> Both {
        let free = self.start.iter().filter(|s| s.is_none()).count();
        match (exact, self.minimax) {
            (_, true) => both!(
                "Remez' exchange makes all six extreme deviations equal, of alternating sign: five constants and the deviation are six unknowns."
            ),
            (false, false) => both!(
                "There are more pairs than unknowns: least squares of the output's deviations, by Gauss-Newton."
            ),
            (true, false) if free == 0 => {
                both!("At the precision points these are linear equations:")
            }
            (true, false) => both!(
                "At the precision points, with the starting angles as unknowns too, solved by Newton's method; at the root they read:"
            ),
        }
    }
}

/// Returns the scales of x and y on the angles, per degree.
fn scales(range: [f64; 2], values: [f64; 2], swings: [f64; 2]) -> Proof {
    let scale = |name: &str, letter: &str, ends: [f64; 2], angle_of: &str, swing: f64| {
        let (way, degrees) = (ends[1] - ends[0], swing.to_degrees());
        format!(
            "\\mu_{name} = \\frac{{{letter}_m − {letter}_0}}{{{angle_of}_m}} = \\frac{{{}}}{{{}}} = {}/\\degree",
            number(way),
            angle(swing),
            number(way / degrees)
        )
    };
    Proof::new(
        both!("Scales: the change of $x$ and of $y$ for each degree of crank and follower:"),
        [
            scale("\\alpha", "x", range, "\\alpha", swings[0]),
            scale("\\varphi", "y", values, "\\varphi", swings[1]),
        ],
    )
}
