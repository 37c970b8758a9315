//! The table of all words on figures, in both languages.

use hodograph_base::diagram::DiagramKind;
use hodograph_base::lang::{Lang, tr};

/// The words of one language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// Language tag.
    pub tag: &'static str,
    /// Caption of the mechanism with its instantaneous centres.
    pub centres: &'static str,
    /// Caption of the circle diagram.
    pub circle_diagram: &'static str,
    /// Caption of the construction of the inflection circle.
    pub curvature: &'static str,
    /// Caption of the paths of a pole.
    pub centrodes: &'static str,
    /// Legend of the lines of the centrodes, in the fixed and in the moving plane.
    pub fixed_moving: &'static str,
    /// Caption of the parts of an acceleration at the moving point.
    pub composite_acceleration: &'static str,
    /// Heading of the velocity equations.
    pub velocities: &'static str,
    /// Heading of the acceleration equations.
    pub accelerations: &'static str,
    /// Heading of the equations of forces.
    pub forces: &'static str,
    /// Heading of the results.
    pub results: &'static str,
    /// Row of magnitudes.
    pub magnitude: &'static str,
    /// Row of directions.
    pub direction: &'static str,
    /// Sense of a positive rotation.
    pub counter_clockwise: &'static str,
    /// Sense of a negative rotation.
    pub clockwise: &'static str,
    /// Word before a similarity.
    pub image: &'static str,
    /// Note after a vector of a translating link; `{}` is the link.
    pub no_turning: &'static str,
    /// Note beside a point that two trials determine.
    pub trials: &'static str,
    /// Legend of the special point `{S}` of a triad; `{1}`, `{2}` are its lines, `{}` the link.
    pub special_point: &'static str,
    /// Legend of a point's mate in a trial: `{X}` is its letter, `{}` the bar that is left out,
    /// `{1}` the point.
    pub mate: &'static str,
    /// Legend of a common point of two links; placeholders as in `special_point`, `{3}` is the
    /// other link.
    pub common_point: &'static str,
    /// A line perpendicular to a guide; `{}` is the point.
    pub square_to_guide: &'static str,
    /// The constraint line of a rolling leg; `{}` is the point of contact.
    pub tangent_at: &'static str,
    /// Number of digits to which drawing and analysis agree; `{}` is the number.
    pub agreement: &'static str,
    /// Effect of the pencil error on the results; `{}` is the error in mm, `{1}` the largest
    /// tolerance in %, `{symbol}` the result that has it.
    pub pencil: &'static str,
    /// Results that the pencil error makes unreadable; `{1}` lists them.
    pub pencil_lost: &'static str,
    /// An answer with uncertain digits; `{}` is the symbol, `{why}` the reason.
    pub uncertain: &'static str,
    /// Legend of the tolerances; `{}` is the pencil error in mm.
    pub by_hand: &'static str,
    /// An intersection at too small an angle; `{}` is the point, `{1}` the angle, `{2}` the pencil
    /// error in mm, `{3}` the displacement of the point.
    pub bad_angle: &'static str,
    /// The displacement; `{}` in mm.
    pub by_mm: &'static str,
    /// The displacement if the point falls off the paper.
    pub off_paper: &'static str,
    /// Advice: a larger scale; `{}` is the factor.
    pub bad_larger: &'static str,
    /// Advice: another special point; placeholders as in `special_point`, `{3}` is the angle.
    pub bad_special: &'static str,
    /// Advice: another pose; `{driver}` is the driver's symbol, `{}` its angle, `{1}` the angle of
    /// the intersection.
    pub bad_pose: &'static str,
    /// Advice: another pose if the driver's angle has no name; `{}` is the angle by which it turns.
    pub bad_turn: &'static str,
    /// Replaces a measurement for a result that is not drawn.
    pub computed: &'static str,
    /// Replaces a measurement if only a longer floating-point format distinguishes the pose from a
    /// singular one.
    pub longer: &'static str,
    /// A change point; `{}` are its links.
    pub change_point: &'static str,
    /// A driver at its limit position; `{}` are the collinear links.
    pub driver_at_limit: &'static str,
    /// A dead centre with all drivers at rest; `{}` are its links.
    pub at_rest: &'static str,
    /// The answers for the motion that was not chosen; `{}` lists them.
    pub other_motion: &'static str,
    /// Replaces the scale of a polygon without vectors.
    pub no_vectors: &'static str,
    /// A virtual (redundant) constraint; `{}` is the part that repeats it, `{why}` the reason.
    pub repeats: &'static str,
    /// A virtual constraint of a pair that is not drawn dashed: a mesh, a second coincident pin.
    pub repeats_alike: &'static str,
    /// A condition on velocities; `{v}` is the vector, `{}` the line, `{mm}` the deviation.
    pub along_velocity: &'static str,
    /// A condition on accelerations; `{a}` is the normal acceleration, `{w}` the velocity.
    pub along_acceleration: &'static str,
    /// Separator of statements on one line.
    pub semicolon: &'static str,
    /// Separator of list members.
    pub comma: &'static str,
}

const EN: Words = in_language(Lang::En);
const ZH: Words = in_language(Lang::Zh);

const fn in_language(lang: Lang) -> Words {
    Words {
        tag: lang.name(),
        centres: tr!(lang, "Instantaneous centres"),
        circle_diagram: tr!(lang, "Circle diagram"),
        curvature: tr!(lang, "Pole, inflection circle, centres of curvature"),
        centrodes: tr!(lang, "Centrodes"),
        fixed_moving: tr!(lang, "solid: fixed; dashed: moving with the link"),
        composite_acceleration: tr!(lang, "Acceleration of the moving point and its parts"),
        velocities: tr!(lang, "Velocities"),
        accelerations: tr!(lang, "Accelerations"),
        forces: tr!(lang, "Forces"),
        results: tr!(lang, "Results"),
        magnitude: tr!(lang, "Magnitude"),
        direction: tr!(lang, "Direction"),
        counter_clockwise: tr!(lang, "counter-clockwise"),
        clockwise: tr!(lang, "clockwise"),
        image: tr!(lang, "image"),
        no_turning: tr!(lang, "link {} does not turn"),
        trials: tr!(lang, "lines of two trials"),
        special_point: tr!(lang, "${S}$: point of link {} where {1} and {2} meet"),
        mate: tr!(
            lang,
            "${X}$: where the bar ${}$ would have ${1}$; $\\delta$ is what the trial lacks"
        ),
        common_point: tr!(lang, "${S}$: common point of links {} and {3}, where {1} and {2} meet"),
        square_to_guide: tr!(lang, "the normal to the guide at ${}$"),
        tangent_at: tr!(lang, "the tangent at ${}$"),
        agreement: tr!(lang, "Drawing and loop equations agree to {} digits."),
        pencil: tr!(
            lang,
            "By hand, marks within {} mm: results within ±{1} % (${symbol}$: ±{1} %)."
        ),
        pencil_lost: tr!(lang, "Drawn by hand, marks within {} mm: {1} cannot be read."),
        uncertain: tr!(lang, "{}: not all digits are certain, {why}"),
        by_hand: tr!(lang, "±: drawn by hand, 95 % of the marks within {} mm."),
        bad_angle: tr!(
            lang,
            "${}$ is found under only ${1}$: a pencil error of {2} mm moves it {3}."
        ),
        by_mm: tr!(lang, "by {} mm"),
        off_paper: tr!(lang, "off the paper"),
        bad_larger: tr!(lang, "Better: {} times as large, where every result is within 1 %."),
        bad_special: tr!(
            lang,
            "Better: the point of link {} where {1} and {2} meet; the lines cross under {3}° or more."
        ),
        bad_pose: tr!(
            lang,
            "Better: the pose at ${driver} = {}\\degree$; the lines cross under {1}°."
        ),
        bad_turn: tr!(
            lang,
            "Better: the pose with ${driver}$ turned by {}°; the lines cross under {1}°."
        ),
        computed: tr!(lang, "from the loop equations"),
        longer: tr!(lang, "from longer numbers"),
        change_point: tr!(
            lang,
            "Change point of links {}: no lines cross on paper, see the loop equations."
        ),
        driver_at_limit: tr!(
            lang,
            "The driver turns back, links {} in line: no lines cross on paper, see the loop equations."
        ),
        at_rest: tr!(lang, "Dead centre of links {}: the driver stands, everything rests."),
        other_motion: tr!(lang, "The other motion: {}."),
        repeats: tr!(lang, "Dashed: {} only repeats what the others fix ({why})."),
        repeats_alike: tr!(
            lang,
            "Virtual constraint: {} only repeats what the others fix ({why})."
        ),
        along_velocity: tr!(lang, "${v} \\perp {}$: {mm} mm off"),
        along_acceleration: tr!(lang, "${a} = {w}^2/{}$: {mm} mm off"),
        no_vectors: tr!(lang, "all vectors are zero, no scale"),
        semicolon: lang.semicolon(),
        comma: lang.comma(),
    }
}

/// Returns the words of a language.
pub const fn words(lang: Lang) -> &'static Words {
    match lang {
        Lang::En => &EN,
        Lang::Zh => &ZH,
    }
}

impl Words {
    /// Returns the language of the words.
    pub fn lang(&self) -> Lang {
        if self.tag == EN.tag { Lang::En } else { Lang::Zh }
    }

    /// Returns the sense of a rotation; empty for zero.
    pub fn sense(&self, value: f64) -> &'static str {
        if value > 0.0 {
            self.counter_clockwise
        } else if value < 0.0 {
            self.clockwise
        } else {
            ""
        }
    }

    /// Returns the heading of the equations of a diagram; the plane has no heading of its own.
    pub fn equations(&self, on: DiagramKind) -> &'static str {
        match on {
            DiagramKind::Acceleration => self.accelerations,
            DiagramKind::Force => self.forces,
            DiagramKind::Plane | DiagramKind::Velocity => self.velocities,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::{label::Label, text};

    #[test]
    fn every_word_has_its_letters() {
        for lang in [Lang::En, Lang::Zh] {
            let debug = format!("{:?}Δ∽°·×", words(lang));
            assert_eq!(text::set(&Label::text(debug)).faults, [], "{lang:?}");
        }
    }
}
