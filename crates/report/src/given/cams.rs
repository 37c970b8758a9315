//! Cams in the given data: the profile or the law, and the form of the follower's end. The pairs
//! and drivers that represent a contact belong to the solution and are not listed.

use super::super::cam::dwell;
use super::GivenSentences;
use hodograph_base::cam::{CamMotion, MotionLaw, ProfileSegment, StageMotion};
use hodograph_scene::{Cam, Follows, GuideId, Lang, PointId};

impl GivenSentences<'_> {
    /// Returns true if a guide represents the contact of a cam.
    pub(super) fn is_contact(&self, g: usize) -> bool {
        self.scene.cams.iter().any(|c| c.contact == Some(GuideId(g)))
    }

    /// Returns true if a point belongs to a cam, as the mark of its angle, and is not listed in the
    /// file.
    pub(super) fn is_of_cam(&self, p: PointId) -> bool {
        self.scene.cams.iter().any(|c| c.span == self.scene.points[p.0].span)
    }

    /// Returns a cam with its follower, in words.
    pub(super) fn cam(&self, c: &Cam) -> String {
        let (cam, follower) = (self.link(c.cam), self.link(c.follower));
        let length = |m: f64| self.scene.length_words(m);
        let end = match (c.follows, self.lang()) {
            (Follows::Edge(_), Lang::En) => "knife edge".to_owned(),
            (Follows::Edge(_), Lang::Zh) => "尖顶".to_owned(),
            (Follows::Roller(_, r), Lang::En) => format!("roller of radius {}", length(r)),
            (Follows::Roller(_, r), Lang::Zh) => format!("滚子半径 {}", length(r)),
            (Follows::Arc(_, r), Lang::En) => format!("round end of radius {}", length(r)),
            (Follows::Arc(_, r), Lang::Zh) => format!("曲面半径 {}", length(r)),
            (Follows::Face(_), Lang::En) => "flat face".to_owned(),
            (Follows::Face(_), Lang::Zh) => "平底".to_owned(),
        };
        let profile = match (&c.circle, c.disc.as_ref().map(|t| &t.disc.motion)) {
            (Some((centre, radius)), _) => match self.lang() {
                Lang::En => {
                    format!("a circle of radius {} about {}", length(*radius), self.point(*centre))
                }
                Lang::Zh => {
                    format!("以 {} 为圆心、半径 {} 的圆", self.point(*centre), length(*radius))
                }
            },
            (None, Some(CamMotion::Profile(segments))) => self.pieces(segments),
            (None, Some(CamMotion::Law { base, program })) => {
                let swings = matches!(
                    c.disc.as_ref().map(|t| t.disc.follower),
                    Some(hodograph_base::cam::Follower::Oscillating { .. })
                );
                let gain = |h: f64| if swings { degrees(h) } else { length(h) };
                let law = |l: MotionLaw| self.tr(l.name(), l.name_zh());
                let over = |a: f64| degrees(a);
                let stages = program.stages().iter().zip(program.outer()).map(|(s, out)| {
                    match (s.way, self.lang()) {
                        (StageMotion::Rise(h, l), Lang::En) => {
                            format!("rise {} over {} ({})", gain(h), over(s.over), law(l))
                        }
                        (StageMotion::Rise(h, l), Lang::Zh) => {
                            format!("推程 {}，转角 {}（{}）", gain(h), over(s.over), law(l))
                        }
                        (StageMotion::Return(h, l), Lang::En) => {
                            format!("return {} over {} ({})", gain(h), over(s.over), law(l))
                        }
                        (StageMotion::Return(h, l), Lang::Zh) => {
                            format!("回程 {}，转角 {}（{}）", gain(h), over(s.over), law(l))
                        }
                        (StageMotion::Dwell, Lang::En) => format!("dwell {}", over(s.over)),
                        (StageMotion::Dwell, Lang::Zh) => {
                            format!("{} {}", dwell(out, Lang::Zh), over(s.over))
                        }
                    }
                });
                let stages: Vec<String> = stages.collect();
                let base = length(*base);
                match self.lang() {
                    Lang::En => format!("base circle {base}, {}", stages.join(", ")),
                    Lang::Zh => format!("基圆半径 {base}，{}", stages.join("；")),
                }
            }
            (None, None) => c.posed.as_ref().map(|p| self.pieces(&p.segments)).unwrap_or_default(),
        };
        match self.lang() {
            Lang::En if profile.is_empty() => format!("cam {cam} with follower {follower} ({end})"),
            Lang::Zh if profile.is_empty() => format!("凸轮 {cam}，从动件 {follower}（{end}）"),
            Lang::En => format!("cam {cam} with follower {follower} ({end}); profile: {profile}"),
            Lang::Zh => format!("凸轮 {cam}，从动件 {follower}（{end}）；廓线：{profile}"),
        }
    }
}

impl GivenSentences<'_> {
    /// Returns the pieces of a profile.
    fn pieces(&self, segments: &[ProfileSegment]) -> String {
        let one = |s: &ProfileSegment| match s {
            ProfileSegment::Line { .. } => self.tr("line", "直线").to_owned(),
            ProfileSegment::Arc { radius, .. } if *radius == 0.0 => {
                self.tr("corner", "尖点").to_owned()
            }
            ProfileSegment::Arc { radius, .. } => {
                format!("{} {}", self.tr("arc", "圆弧"), self.scene.length_words(*radius))
            }
        };
        segments.iter().map(one).collect::<Vec<_>>().join(self.words().comma)
    }
}

fn degrees(radians: f64) -> String {
    format!("{}°", hodograph_base::digits::shortest((radians.to_degrees() * 1e8).round() / 1e8))
}
