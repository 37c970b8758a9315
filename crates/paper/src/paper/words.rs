//! The table of all words on figures, in both languages.

use hodograph_base::diagram::DiagramKind;
use hodograph_base::lang::Lang;

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

const EN: Words = Words {
    tag: "en",
    centres: "Instantaneous centres",
    circle_diagram: "Circle diagram",
    curvature: "Pole, inflection circle, centres of curvature",
    centrodes: "Centrodes",
    fixed_moving: "solid: fixed; dashed: moving with the link",
    composite_acceleration: "Acceleration of the moving point and its parts",
    velocities: "Velocities",
    accelerations: "Accelerations",
    forces: "Forces",
    results: "Results",
    magnitude: "Magnitude",
    direction: "Direction",
    counter_clockwise: "counter-clockwise",
    clockwise: "clockwise",
    image: "image",
    no_turning: "link {} does not turn",
    trials: "lines of two trials",
    special_point: "${S}$: point of link {} where {1} and {2} meet",
    mate: "${X}$: where the bar ${}$ would have ${1}$; $\\delta$ is what the trial lacks",
    common_point: "${S}$: common point of links {} and {3}, where {1} and {2} meet",
    square_to_guide: "the normal to the guide at ${}$",
    tangent_at: "the tangent at ${}$",
    agreement: "Drawing and loop equations agree to {} digits.",
    pencil: "By hand, marks within {} mm: results within ±{1} % (${symbol}$: ±{1} %).",
    pencil_lost: "Drawn by hand, marks within {} mm: {1} cannot be read.",
    uncertain: "{}: not all digits are certain, {why}",
    by_hand: "±: drawn by hand, 95 % of the marks within {} mm.",
    bad_angle: "${}$ is found under only ${1}$: a pencil error of {2} mm moves it {3}.",
    by_mm: "by {} mm",
    off_paper: "off the paper",
    bad_larger: "Better: {} times as large, where every result is within 1 %.",
    bad_special: "Better: the point of link {} where {1} and {2} meet; the lines cross under {3}° or more.",
    bad_pose: "Better: the pose at ${driver} = {}\\degree$; the lines cross under {1}°.",
    bad_turn: "Better: the pose with ${driver}$ turned by {}°; the lines cross under {1}°.",
    computed: "from the loop equations",
    longer: "from longer numbers",
    change_point: "Change point of links {}: no lines cross on paper, see the loop equations.",
    driver_at_limit: "The driver turns back, links {} in line: no lines cross on paper, see the loop equations.",
    at_rest: "Dead centre of links {}: the driver stands, everything rests.",
    other_motion: "The other motion: {}.",
    repeats: "Dashed: {} only repeats what the others fix ({why}).",
    repeats_alike: "Virtual constraint: {} only repeats what the others fix ({why}).",
    along_velocity: "${v} \\perp {}$: {mm} mm off",
    along_acceleration: "${a} = {w}^2/{}$: {mm} mm off",
    no_vectors: "all vectors are zero, no scale",
    semicolon: Lang::En.semicolon(),
    comma: Lang::En.comma(),
};

const ZH: Words = Words {
    tag: "zh",
    centres: "速度瞬心",
    circle_diagram: "瞬心多边形",
    curvature: "瞬心、拐点圆与曲率中心",
    centrodes: "瞬心线",
    fixed_moving: "实线：定瞬心线；虚线：动瞬心线",
    composite_acceleration: "动点的加速度及其各分量",
    velocities: "速度分析",
    accelerations: "加速度分析",
    forces: "力分析",
    results: "结果",
    magnitude: "大小",
    direction: "方向",
    counter_clockwise: "逆时针",
    clockwise: "顺时针",
    image: "影像",
    no_turning: "构件 {} 作平动",
    trials: "两次试作的直线",
    special_point: "特殊点 ${S}$：构件 {} 上 {1} 与 {2} 的交点",
    mate: "${X}$：按杆 ${}$ 的约束 ${1}$ 应在的位置，$\\delta$ 为该次试作的差值",
    common_point: "特殊点 ${S}$：构件 {} 与 {3} 的公共点，即 {1} 与 {2} 的交点",
    square_to_guide: "过 ${}$ 的导路垂线",
    tangent_at: "过 ${}$ 的公切线",
    agreement: "图解与解析结果有 {} 位数字一致。",
    pencil: "手工作图（点误差不超过 {} mm）：各结果误差不超过 ±{1} %（${symbol}$：±{1} %）。",
    pencil_lost: "手工作图（点误差不超过 {} mm）：图上读不出 {1}。",
    uncertain: "{}：并非全部数字可靠，{why}",
    by_hand: "±：手工作图的误差（95% 的点误差不超过 {} mm）。",
    bad_angle: "求 ${}$ 的两线交角仅 ${1}$：{2} mm 的作图误差使该点{3}。",
    by_mm: "偏移 {} mm",
    off_paper: "移出图纸",
    bad_larger: "改进：图形放大到 {} 倍，各结果的误差不超过 1%。",
    bad_special: "改进：改取构件 {}（扩大）上 {1} 与 {2} 的交点为特殊点，交角不小于 {3}°。",
    bad_pose: "改进：取 ${driver} = {}\\degree$ 时，交角为 {1}°。",
    bad_turn: "改进：${driver}$ 再转过 {}° 时，交角为 {1}°。",
    computed: "由解析法求得",
    longer: "由高精度计算求得",
    change_point: "构件 {} 处于运动不确定位置：图上两线重合，结果由解析法求得。",
    driver_at_limit: "原动件在极限位置折返，构件 {} 共线：图上两线重合，结果由解析法求得。",
    at_rest: "构件 {} 处于死点，原动件不动：各构件静止。",
    other_motion: "另一种运动：{}。",
    repeats: "虚线：{} 为虚约束（{why}）。",
    repeats_alike: "{} 为虚约束（{why}）。",
    along_velocity: "${v} \\perp {}$：偏差 {mm} mm",
    along_acceleration: "${a} = {w}^2/{}$：偏差 {mm} mm",
    no_vectors: "各矢量均为零，不需比例尺",
    semicolon: Lang::Zh.semicolon(),
    comma: Lang::Zh.comma(),
};

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
