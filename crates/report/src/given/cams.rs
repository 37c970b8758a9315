//! Cams in the given data: the profile or the law, and the form of the follower's end. The pairs
//! and drivers that represent a contact belong to the solution and are not listed.

use super::super::cam::dwell;
use super::GivenSentences;
use hodograph_base::cam::{CamMotion, MotionLaw, ProfileSegment, StageMotion};
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Cam, Follows, GuideId, PointId};

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
        let end = match c.follows {
            Follows::Edge(_) => tr!(self.lang(), "knife edge").to_owned(),
            Follows::Roller(_, r) => say!(self.lang(), "roller of radius {}", length(r)),
            Follows::Arc(_, r) => say!(self.lang(), "round end of radius {}", length(r)),
            Follows::Face(_) => tr!(self.lang(), "flat face").to_owned(),
        };
        let profile = match (&c.circle, c.disc.as_ref().map(|t| &t.disc.motion)) {
            (Some((centre, radius)), _) => say!(
                self.lang(),
                "a circle of radius {} about {}",
                length(*radius),
                self.point(*centre)
            ),
            (None, Some(CamMotion::Profile(segments))) => self.pieces(segments),
            (None, Some(CamMotion::Law { base, program })) => {
                let swings = matches!(
                    c.disc.as_ref().map(|t| t.disc.follower),
                    Some(hodograph_base::cam::Follower::Oscillating { .. })
                );
                let gain = |h: f64| if swings { degrees(h) } else { length(h) };
                let law = |l: MotionLaw| l.words(self.lang());
                let over = |a: f64| degrees(a);
                let stages = program.stages().iter().zip(program.outer()).map(|(s, out)| {
                    let (lang, angle) = (self.lang(), over(s.over));
                    match s.way {
                        StageMotion::Rise(h, l) => {
                            say!(lang, "rise {} over {angle} ({})", gain(h), law(l))
                        }
                        StageMotion::Return(h, l) => {
                            say!(lang, "return {} over {angle} ({})", gain(h), law(l))
                        }
                        StageMotion::Dwell => format!("{} {angle}", dwell(out, lang)),
                    }
                });
                let stages: Vec<String> = stages.collect();
                let base = length(*base);
                say!(
                    self.lang(),
                    "base circle {base}, {}",
                    stages.join(self.lang().pick([", ", "；"]))
                )
            }
            (None, None) => c.posed.as_ref().map(|p| self.pieces(&p.segments)).unwrap_or_default(),
        };
        match profile.is_empty() {
            true => say!(self.lang(), "cam {cam} with follower {follower} ({end})"),
            false => {
                say!(self.lang(), "cam {cam} with follower {follower} ({end}); profile: {profile}")
            }
        }
    }
}

impl GivenSentences<'_> {
    /// Returns the pieces of a profile.
    fn pieces(&self, segments: &[ProfileSegment]) -> String {
        let one = |s: &ProfileSegment| match s {
            ProfileSegment::Line { .. } => tr!(self.lang, "line").to_owned(),
            ProfileSegment::Arc { radius, .. } if *radius == 0.0 => {
                tr!(self.lang, "corner").to_owned()
            }
            ProfileSegment::Arc { radius, .. } => {
                format!("{} {}", tr!(self.lang, "arc"), self.scene.length_words(*radius))
            }
        };
        segments.iter().map(one).collect::<Vec<_>>().join(self.lang().comma())
    }
}

fn degrees(radians: f64) -> String {
    format!("{}°", hodograph_base::digits::shortest((radians.to_degrees() * 1e8).round() / 1e8))
}
