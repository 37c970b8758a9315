//! The languages of the program.

use crate::diag::Both;
pub use hodograph_translate::{zh, zh_format};

/// A language of the figures and texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lang {
    /// English.
    #[default]
    En,
    /// Chinese.
    Zh,
}

impl Lang {
    /// Returns the language with a name of the format: `en`, `zh`.
    pub fn named(name: &str) -> Option<Lang> {
        match name {
            "en" => Some(Lang::En),
            "zh" => Some(Lang::Zh),
            _ => None,
        }
    }

    /// Returns the language's name in the format.
    pub const fn name(self) -> &'static str {
        match self {
            Lang::En => "en",
            Lang::Zh => "zh",
        }
    }

    /// Returns a text in this language.
    pub fn of(self, text: &Both) -> &str {
        match self {
            Lang::En => &text.en,
            Lang::Zh => &text.zh,
        }
    }

    /// Returns the separator of names in a list.
    pub const fn comma(self) -> &'static str {
        self.pick([", ", "、"])
    }

    /// Returns the separator of statements on one line.
    pub const fn semicolon(self) -> &'static str {
        self.pick(["; ", "；"])
    }

    /// Returns the element of this language, `lang.pick(each!("stroke"))`.
    pub const fn pick<T: Copy>(self, [en, zh]: [T; 2]) -> T {
        match self {
            Lang::En => en,
            Lang::Zh => zh,
        }
    }
}

/// Formats a text in one language, `say!(lang, "link {}", name)`; see [`both!`](crate::both!).
#[macro_export]
macro_rules! say {
    ($lang:expr, $context:literal => $en:literal $(, $value:expr)* $(,)?) => {
        match $lang {
            $crate::lang::Lang::En => format!($en $(, $crate::diag::Piece::en(&$value))*),
            $crate::lang::Lang::Zh => {
                $crate::lang::zh_format!($context => $en $(, $crate::diag::Piece::zh(&$value))*)
            }
        }
    };
    ($lang:expr, $en:literal $(, $value:expr)* $(,)?) => {
        match $lang {
            $crate::lang::Lang::En => format!($en $(, $crate::diag::Piece::en(&$value))*),
            $crate::lang::Lang::Zh => {
                $crate::lang::zh_format!($en $(, $crate::diag::Piece::zh(&$value))*)
            }
        }
    };
}
pub use say;

/// Returns a fixed text in one language, `tr!(lang, "stroke")`; see [`both!`](crate::both!).
#[macro_export]
macro_rules! tr {
    ($lang:expr, $($text:tt)*) => {
        $crate::lang::Lang::pick($lang, $crate::each!($($text)*))
    };
}
pub use tr;

/// Returns a fixed text in each language, English first; for tables. See [`Lang::pick`].
#[macro_export]
macro_rules! each {
    ($context:literal => $en:literal $(,)?) => {
        [$en, $crate::lang::zh!($context => $en)]
    };
    ($en:literal $(,)?) => {
        [$en, $crate::lang::zh!($en)]
    };
}
pub use each;
