//! The arguments of texture statements: options, then a file name that may hold blanks.

use super::number::finite;
use super::text::{SourceText, Statement};
use crate::error::{LoadError, quote};
use crate::nearest::suggestion;
use glam::Vec3;
use heliostat_scene::texture::{UvTransform, Wrap};

/// Which channel of the image a single number comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Channel {
    Red,
    Green,
    Blue,
    /// Alpha (`m`, the matte channel).
    Matte,
    Luminance,
}

/// A texture as MTL describes it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    /// As written, Windows separators turned.
    pub(super) file: String,
    /// Byte offset of the statement, for messages.
    pub(super) offset: usize,
    pub(super) uv: UvTransform,
    pub(super) wrap: Wrap,
    /// `-imfchan`.
    pub(super) channel: Option<Channel>,
    /// `-bm`.
    pub(super) bump_multiplier: f32,
    /// The gain of `-mm base gain`.
    pub(super) gain: f32,
    /// Options that change the look and are not drawn.
    pub(super) ignored: Vec<&'static str>,
}

/// The options of texture statements.
const OPTIONS: [&str; 13] = [
    "-o", "-s", "-t", "-mm", "-bm", "-boost", "-texres", "-clamp", "-blendu", "-blendv", "-cc", "-imfchan",
    "-type",
];

impl Map {
    /// Reads `keyword [options] file`.
    pub(super) fn parse(source: &SourceText<'_>, statement: &Statement<'_>) -> Result<Self, LoadError> {
        let mut map = Self {
            file: String::new(),
            offset: source.offset(statement.keyword),
            uv: UvTransform::default(),
            wrap: Wrap::Repeat,
            channel: None,
            bump_multiplier: 1.0,
            gain: 1.0,
            ignored: Vec::new(),
        };
        let mut rest = statement.name();
        // A word with a point is a file, even if it starts with a minus.
        while let Some((option, after)) =
            next_word(rest).filter(|(w, _)| w.starts_with('-') && !w.contains('.'))
        {
            let mut arguments = Arguments { source, option, rest: after };
            map.option(&mut arguments)?;
            rest = arguments.rest;
        }
        if rest.is_empty() {
            let error = source.error(statement.keyword, format!("`{}` names no file", statement.keyword));
            return Err(error.with_help("write the file name behind the options"));
        }
        map.file = rest.trim_matches('"').replace('\\', "/");
        Ok(map)
    }

    fn option(&mut self, arguments: &mut Arguments<'_, '_>) -> Result<(), LoadError> {
        match arguments.option {
            "-o" => self.uv.offset = arguments.numbers([0.0; 3])?.truncate(),
            // A missing v is 1, as the manual says, not u.
            "-s" => self.uv.scale = arguments.numbers([1.0; 3])?.truncate(),
            "-t" => {
                let turbulence = arguments.numbers([0.0; 3])?;
                self.ignored.extend((turbulence != Vec3::ZERO).then_some("-t"));
            }
            "-mm" => {
                let [base, gain, _] = arguments.numbers([0.0, 1.0, 0.0])?.to_array();
                self.gain = gain;
                self.ignored.extend((base != 0.0).then_some("-mm with a base"));
            }
            "-bm" => self.bump_multiplier = arguments.numbers([1.0, 0.0, 0.0])?.x,
            "-boost" | "-texres" => {
                arguments.numbers([0.0; 3])?;
            }
            "-clamp" => self.wrap = if arguments.word()? == "on" { Wrap::Clamp } else { Wrap::Repeat },
            "-blendu" | "-blendv" => {
                arguments.word()?;
            }
            "-cc" => self.ignored.extend((arguments.word()? == "on").then_some("-cc")),
            "-imfchan" => self.channel = Some(arguments.channel()?),
            "-type" => {
                arguments.word()?;
            }
            _ => return Err(arguments.unknown_option()),
        }
        Ok(())
    }
}

/// What follows an option.
struct Arguments<'s, 'a> {
    source: &'s SourceText<'s>,
    option: &'a str,
    rest: &'a str,
}

impl<'a> Arguments<'_, 'a> {
    /// One to three numbers over their defaults.
    fn numbers(&mut self, defaults: [f32; 3]) -> Result<Vec3, LoadError> {
        let mut numbers = defaults;
        let mut count = 0;
        while let Some((word, after)) =
            next_word(self.rest).filter(|(w, _)| count < 3 && w.parse::<f32>().is_ok())
        {
            numbers[count] = finite(self.source, word)?;
            count += 1;
            self.rest = after;
        }
        if count == 0 {
            let error = self.source.error(self.option, format!("`{}` needs a number", self.option));
            return Err(error.with_help("write the option's numbers in front of the file name"));
        }
        Ok(Vec3::from_array(numbers))
    }

    fn word(&mut self) -> Result<&'a str, LoadError> {
        let (word, after) = next_word(self.rest)
            .ok_or_else(|| self.source.error(self.option, format!("`{}` needs a value", self.option)))?;
        self.rest = after;
        Ok(word)
    }

    fn channel(&mut self) -> Result<Channel, LoadError> {
        let word = self.word()?;
        Ok(match word {
            "r" => Channel::Red,
            "g" => Channel::Green,
            "b" => Channel::Blue,
            "m" => Channel::Matte,
            "l" => Channel::Luminance,
            _ => {
                let error = self.source.error(word, format!("{} is not a channel", quote(word)));
                return Err(error.with_help("expected r, g, b, m (alpha) or l (luminance)"));
            }
        })
    }

    fn unknown_option(&self) -> LoadError {
        let error =
            self.source.error(self.option, format!("the texture option {} is not known", quote(self.option)));
        match suggestion(self.option, OPTIONS) {
            Some(help) => error.with_help(help),
            None => error.with_help("see the options of map_Kd in the MTL format"),
        }
    }
}

/// The first word and what follows it; `None` at the end.
fn next_word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (end > 0).then(|| (&text[..end], text[end..].trim_start()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;
    use std::path::Path;

    fn read(text: &str) -> Result<Map, String> {
        let source = SourceText::decode(Path::new("a.mtl"), text.as_bytes()).unwrap();
        let statement = source.statements().next().unwrap();
        Map::parse(&source, &statement).map_err(|error| error.to_string())
    }

    #[test]
    fn file_names_keep_blanks_and_lose_windows_separators() {
        assert_eq!(read("map_Kd a b.png").unwrap().file, "a b.png");
        assert_eq!(read("map_Kd .\\tex\\a.png").unwrap().file, "./tex/a.png");
        assert_eq!(read("map_Kd \"a b.png\"").unwrap().file, "a b.png");
        assert_eq!(read("map_Kd -odd.png").unwrap().file, "-odd.png");
    }

    #[test]
    fn options_do_not_end_up_in_the_name() {
        let map = read("map_Kd -s 2 3 4 -o 0.5 -blendu off -mm 0 2 -clamp on -imfchan g 1 b.png").unwrap();
        assert_eq!(map.file, "1 b.png");
        assert_eq!((map.uv.scale, map.uv.offset), (Vec2::new(2.0, 3.0), Vec2::new(0.5, 0.0)));
        assert_eq!((map.gain, map.wrap, map.channel), (2.0, Wrap::Clamp, Some(Channel::Green)));
        assert_eq!(map.ignored, [""; 0]);
    }

    #[test]
    fn a_missing_v_of_the_scale_is_one() {
        assert_eq!(read("map_Kd -s 2 a.png").unwrap().uv.scale, Vec2::new(2.0, 1.0));
    }

    #[test]
    fn what_is_not_drawn_is_remembered() {
        assert_eq!(
            read("map_Kd -t 1 0 0 -mm 0.5 1 -cc on a.png").unwrap().ignored,
            ["-t", "-mm with a base", "-cc"]
        );
    }

    #[test]
    fn wrong_options_are_named() {
        assert_eq!(
            read("map_Kd -clmp on a.png").unwrap_err(),
            "a.mtl:1:8: the texture option `-clmp` is not known; did you mean `-clamp`?"
        );
        assert!(read("map_Kd -s a.png").unwrap_err().contains("`-s` needs a number"));
        assert!(read("map_Kd -imfchan q a.png").unwrap_err().contains("`q` is not a channel"));
        assert!(read("map_Kd -s 1 1 1").unwrap_err().contains("names no file"));
        assert!(read("map_Kd").unwrap_err().contains("names no file"));
        assert!(read("map_Kd -clamp").unwrap_err().contains("`-clamp` needs a value"));
    }
}
