//! Photometric files of lamps: IES LM-63 of 1986, 1991, 1995 and 2002.
//!
//! Read are type C files, with `TILT=NONE` or `TILT=INCLUDE`, whose factors for lamps that hang askew are passed over. Numbers
//! may stand on any lines. Candela are multiplied by the multiplier, the ballast factor and, before 1995, by the factor of lamp
//! and ballast.
//!
//! # Source
//! ANSI/IESNA LM-63-2002, "Standard File Format for the Electronic Transfer of Photometric Data"; Bourke, "IES Lighting format".

use heliostat_scene::Profile;

/// Most bytes of a file, and most angles of one kind.
pub(crate) const MOST_BYTES: u64 = 16 << 20;
const MOST_ANGLES: f64 = 4096.0;
/// Most values of a file.
const MOST_VALUES: usize = 1 << 20;

/// What is wrong with a file, where, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct IesError {
    /// From 1.
    pub(crate) line: usize,
    pub(crate) message: String,
    pub(crate) help: &'static str,
}

/// Numbers of a file in turn.
struct Numbers<'a> {
    /// With the number of the line.
    words: Vec<(usize, &'a str)>,
    next: usize,
}

/// A lamp.
///
/// # Errors
/// When the file is no photometric file of a kind that is read, or is damaged.
pub(crate) fn parse(text: &str) -> Result<Profile, IesError> {
    let lines = || text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let tilt = lines().find_map(|(i, line)| {
        let (key, value) = line.split_once('=')?;
        (key.trim().eq_ignore_ascii_case("TILT")).then_some((i, value.trim()))
    });
    let Some((at, tilt)) = tilt else {
        return Err(error(
            1,
            "there is no line that begins with `TILT=`",
            "name a photometric file of IES LM-63",
        ));
    };
    let is_old = !["IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019"]
        .iter()
        .any(|version| text.trim_start().starts_with(version));
    let words = lines().skip(at).flat_map(|(i, line)| {
        let words = line.split(|c: char| c.is_whitespace() || c == ',');
        words.filter(|word| !word.is_empty()).map(move |word| (i, word))
    });
    let mut numbers = Numbers { words: words.collect(), next: 0 };
    match tilt.to_ascii_uppercase().as_str() {
        "NONE" => {}
        "INCLUDE" => {
            numbers.next("the position of the lamp")?;
            let pairs = numbers.count("the number of tilts")?;
            numbers.list(2 * pairs, "the tilts and their factors")?;
        }
        _ => {
            return Err(error(
                at,
                "the tilts are in another file",
                "write `TILT=NONE`, or put them here after `TILT=INCLUDE`",
            ));
        }
    }
    lamp(&mut numbers, is_old)
}

/// What follows the tilts.
fn lamp(numbers: &mut Numbers<'_>, is_old: bool) -> Result<Profile, IesError> {
    numbers.list(2, "the number of lamps and their lumens")?;
    let multiplier = numbers.next("the multiplier")?;
    let (vertical, horizontal) =
        (numbers.count("the number of vertical angles")?, numbers.count("the number of horizontal angles")?);
    let kind = numbers.next("the photometric type")?;
    if kind != 1.0 {
        let message = format!(
            "photometry of type {} is not read",
            if kind == 2.0 {
                "B"
            } else if kind == 3.0 {
                "A"
            } else {
                "?"
            }
        );
        return Err(error(numbers.line(), &message, "convert the file to type C"));
    }
    numbers.list(4, "the units and the size of the lamp")?;
    let (ballast, lamp) =
        (numbers.next("the ballast factor")?, numbers.next("the factor of lamp and ballast")?);
    numbers.next("the watts")?;
    let factor = multiplier * ballast * if is_old { lamp } else { 1.0 };
    let start = numbers.line();
    let vertical = numbers.list(vertical, "the vertical angles")?;
    let horizontal = numbers.list(horizontal, "the horizontal angles")?;
    if vertical.len() * horizontal.len() > MOST_VALUES {
        return Err(error(start, "there are too many angles", "thin out the measured angles"));
    }
    let candela = numbers.list(vertical.len() * horizontal.len(), "the candela")?;
    let candela = candela.into_iter().map(|c| (factor * c) as f32).collect();
    let turn = horizontal.last().copied().unwrap_or(0.0) - horizontal.first().copied().unwrap_or(0.0);
    let spans = [0.0, 90.0, 180.0, 360.0];
    if !spans.contains(&turn) {
        let message = format!("the horizontal angles cover {turn} degrees");
        return Err(error(start, &message, "let them cover 0, 90, 180 or 360"));
    }
    let radians = |angles: Vec<f64>| angles.into_iter().map(|a| a.to_radians() as f32).collect();
    Profile::new(radians(vertical), radians(horizontal), candela).ok_or_else(|| {
        let help = "let angles ascend, vertical ones within 0 to 180 and horizontal ones within 0 to 360, and candela be at least 0";
        error(start, "angles or candela make no sense", help)
    })
}

impl Numbers<'_> {
    fn next(&mut self, what: &str) -> Result<f64, IesError> {
        let Some(&(line, word)) = self.words.get(self.next) else {
            return Err(error(self.line(), &format!("the file ends before {what}"), "get the whole file"));
        };
        self.next += 1;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| {
            let word: String = word.chars().take(20).collect();
            error(line, &format!("{word:?} stands where {what} should be"), "write a number")
        })
    }

    fn count(&mut self, what: &str) -> Result<usize, IesError> {
        let count = self.next(what)?;
        if count.fract() == 0.0 && (1.0..=MOST_ANGLES).contains(&count) {
            return Ok(count as usize);
        }
        Err(error(self.line(), &format!("{what} is {count}"), "write a whole number from 1 to 4096"))
    }

    fn list(&mut self, count: usize, what: &str) -> Result<Vec<f64>, IesError> {
        // What is not there needs no room.
        let mut list = Vec::with_capacity(count.min(self.words.len() - self.next));
        for _ in 0..count {
            list.push(self.next(what)?);
        }
        Ok(list)
    }

    /// The line of the last number.
    fn line(&self) -> usize {
        self.next.checked_sub(1).and_then(|i| self.words.get(i)).map_or(1, |word| word.0)
    }
}

fn error(line: usize, message: &str, help: &'static str) -> IesError {
    IesError { line, message: message.to_owned(), help }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::FRAC_PI_4;

    const LAMP: &str = "IESNA:LM-63-1995\r\n[TEST] 1\r\n[MANUFAC] nobody\r\nTILT=NONE\r\n1 1000 2.0 3 2 1 1 0 0 0\r\n\
        0.5 1.0 20\r\n0 45 90\r\n0 90\r\n100 80\r\n60, 40 20 0\r\n";

    #[test]
    fn numbers_are_read_wherever_they_stand() {
        let lamp = parse(LAMP).unwrap();
        assert_eq!(lamp.peak(), 100.0);
        assert_eq!(lamp.intensity(FRAC_PI_4, 0.0), 80.0);
        assert_eq!(lamp.intensity(FRAC_PI_4, 2.0 * FRAC_PI_4), 20.0);
        let tilted = LAMP.replace("TILT=NONE", "TILT=INCLUDE\r\n1\r\n2\r\n0 90\r\n1 0.9");
        assert_eq!(parse(&tilted), Ok(lamp));
        // Before 1995 the second factor counts.
        let old = LAMP.replace("IESNA:LM-63-1995\r\n", "").replace("0.5 1.0 20", "0.5 0.5 20");
        assert_eq!(parse(&old).unwrap().peak(), 50.0);
    }

    #[test]
    fn what_is_not_read_says_why_and_where() {
        let message = |text: &str| parse(text).map_err(|e| (e.line, e.message)).unwrap_err();
        assert_eq!(message("hello").0, 1);
        assert_eq!(
            message(&LAMP.replace("3 2 1 1", "3 2 2 1")),
            (5, "photometry of type B is not read".to_owned())
        );
        assert_eq!(
            message(&LAMP.replace("=NONE", "=tilt.txt")),
            (4, "the tilts are in another file".to_owned())
        );
        assert_eq!(
            message(&LAMP.replace("60,", "6O,")),
            (10, "\"6O\" stands where the candela should be".to_owned())
        );
        assert_eq!(message(&LAMP.replace("2.0 3 2", "2.0 1e9 2")).0, 5);
        assert_eq!(message(&LAMP.replace("0 45 90", "0 90 45")).1, "angles or candela make no sense");
        assert_eq!(
            message(&LAMP.replace("\n0 90\r", "\n0 70\r")).1,
            "the horizontal angles cover 70 degrees"
        );
        assert_eq!(message(&LAMP.replace("60,", "-60,")).1, "angles or candela make no sense");
    }

    #[test]
    fn no_cut_and_no_byte_brings_it_down() {
        for cut in 0..LAMP.len() {
            let _ = parse(&LAMP[..cut]);
            for byte in ['9', 'e', '-', ' ', '=', 'N'] {
                let mut text = LAMP.to_owned();
                text.replace_range(cut..cut + 1, &byte.to_string());
                let _ = parse(&text);
            }
        }
    }
}
