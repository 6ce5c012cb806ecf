//! RAPID, the language of ABB's controllers.
//!
//! | concept | module |
//! | --- | --- |
//! | a job that can be handed over in it | `accepts` |
//! | a program's text | `write` |
//! | modules into data and procedures, joint targets, zones and tools; the motion of a program | `parse`; `read` |
//! | zones and speeds by name; names that are taken | here |

mod accepts;
mod parse;
mod read;
mod write;

use crate::dialect::{Dialect, Points, ReadError};
use crate::maker_joints::{self, Joint3};
use crate::program::{Program, ProgramFile};
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use platewash_kinematics::RobotModel;
use platewash_workcell::job::JobTerms;

/// Shortest time between two points \[s\].
const LEAST_S: f64 = 0.01;

/// Endings of file names, in small letters.
const ENDINGS: [&str; 5] = [".mod", ".modx", ".prg", ".sys", ".sysx"];

/// RAPID, the language of ABB's controllers.
#[derive(Debug)]
pub struct Rapid;

impl Dialect for Rapid {
    fn name(&self) -> &'static str {
        "rapid"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        ENDINGS.iter().any(|ending| file.ends_in(ending)) || begins_a_module(&file.text)
    }

    fn points(&self) -> Points {
        Points::Chords { least_s: LEAST_S }
    }

    fn assumptions(&self) -> &'static [&'static str] {
        &[
            "Between two targets the controller moves evenly and straight in the joints; it rounds targets in a zone by a parabola that \
             begins at the zone's edge, and a zone reaches no farther than half way to the next target.",
            "The controller keeps the time of every \\T, also where it is as short as the nearest two points.",
            "The controller's tool0 is the mounting frame of the plan's arm: origin at the flange, z out of it.",
            "The task has no external axes, and no other program moves the arm.",
            "Nobody has run this program on a controller or in RobotStudio.",
        ]
    }

    fn has_maker_joints(&self) -> bool {
        true
    }

    fn accepts(&self, job: &JobTerms, arm: &RobotModel) -> Result<(), Refusal> {
        accepts::accepts(job, arm)
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        write::modules(program)
    }

    fn read(&self, files: &[ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError> {
        read::reading(files, count_of_joint_3(files, arm)?)
    }
}

/// The count of axis 3 that a program's head states, or that is known of the arm.
fn count_of_joint_3(files: &[ProgramFile], arm: &RobotModel) -> Result<Joint3, ReadError> {
    let stated = ExportSettings::stated(files, ExportSettings::default()).and_then(|settings| settings.joint_3);
    let name = files.first().map_or("(no file)", |file| &file.name);
    maker_joints::check(&Rapid, arm, stated).map_err(|refusal| {
        let line = ExportSettings {
            joint_3: Some(Joint3::WithJoint2),
            ..ExportSettings::default()
        };
        let line = line.lines().pop().unwrap_or_default();
        ReadError::at(
            name,
            1,
            format!("expected a line such as \"{line}\" at the head, found none. {refusal}"),
        )
    })?;
    Ok(stated.unwrap_or_default())
}

/// Text of a module that is not UTF-8: ISO 8859-1, in which controllers and editors write comments. Of the bytes that are signs in Windows'
/// encoding alone only the place is kept; one of them ends lines elsewhere, and stays for the reader to refuse.
pub(crate) fn text_of_latin_1(bytes: &[u8]) -> String {
    const NEXT_LINE: u8 = 0x85;
    let sign = |byte: &u8| match byte {
        0x80..=0x9f if *byte != NEXT_LINE => char::REPLACEMENT_CHARACTER,
        byte => char::from(*byte),
    };
    bytes.iter().map(sign).collect()
}

/// Checks that the first word outside of comments and the file's header is `MODULE`.
fn begins_a_module(text: &str) -> bool {
    let outside = |line: &&str| {
        let line = line.trim_start();
        !line.is_empty() && !line.starts_with('!')
    };
    let first = text.lines().find(outside).unwrap_or_default().trim_start();
    first.starts_with("%%%") || first.get(..7).is_some_and(|word| word.eq_ignore_ascii_case("MODULE "))
}

/// Keywords, in capitals.
const KEYWORDS: &str = "ALIAS AND BACKWARD CASE CONNECT CONST DEFAULT DIV DO ELSE ELSEIF ENDFOR ENDFUNC ENDIF ENDMODULE ENDPROC \
                        ENDRECORD ENDTEST ENDTRAP ENDWHILE ERROR EXIT FALSE FOR FROM FUNC GOTO IF INOUT LOCAL MOD MODULE NOSTEPIN NOT \
                        NOVIEW OR PERS PROC RAISE READONLY RECORD RETRY RETURN STEP SYSMODULE TASK TEST THEN TO TRAP TRUE TRYNEXT \
                        UNDO VAR VIEWONLY WHILE WITH XOR";

/// Types, functions and data of the controller that programs may use, and its common instructions, in small letters.
const CONTROLLER: &str = "num byte errnum bool string pos orient pose confdata robjoint extjoint jointtarget robtarget loaddata tooldata \
                          wobjdata zonedata speeddata abs sqrt sin cos tan round trunc atan2 numtostr valtostr strlen dim present \
                          cjointt pi stempty tool0 load0 wobj0 fine vmax moveabsj waittime tperase tpwrite errwrite confj confl \
                          singarea accset velset set reset setdo setgo setao pulsedo invertdo movej movel movec moveextj movejdo \
                          moveldo movecdo movejsync movelsync movecsync triggj triggl triggc triggabsj searchl searchc stop break \
                          waituntil waitdi waitdo waitgi waitgo waitai waitao waitrob waitload tpreadfk tpreadnum startmove stopmove \
                          speedrefresh pathacclim worldacclim motionsup softact softdeact gripload pdispon pdispoff pdispset eoffson \
                          eoffsoff eoffsset actunit deactunit isignaldi isignaldo itimer ienable idisable";

/// Checks that a name is a keyword or the controller's own, in any case of letters.
pub(crate) fn is_taken(name: &str) -> bool {
    let (capitals, small) = (name.to_ascii_uppercase(), name.to_ascii_lowercase());
    KEYWORDS.split_ascii_whitespace().any(|word| word == capitals)
        || CONTROLLER.split_ascii_whitespace().any(|word| word == small)
        || zone_mm(&small).is_some()
        || is_speed(&small)
}

/// Zones: radius at the tip \[mm\], `z1` and so on; that of `z0` is 0.3 mm.
const ZONES: [u16; 14] = [0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200];

/// Speeds of the tip \[mm/s\]: `v5` and so on.
const SPEEDS: [u16; 25] = [
    5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500, 3000, 4000, 5000,
    6000, 7000,
];

/// The number in a name in small letters of which there is one a number.
fn numbered(name: &str, prefix: char, numbers: &[u16]) -> Option<u16> {
    let number = name.strip_prefix(prefix)?.parse().ok()?;
    (numbers.contains(&number) && name == format!("{prefix}{number}")).then_some(number)
}

/// The zone with a radius at the tip \[m\], if there is one by name.
pub(crate) fn zone_named(radius_m: f64) -> Option<String> {
    let is_it = |name: &String| zone_mm(name).is_some_and(|mm| (f64::from(mm) - radius_m * 1e3).abs() < 1e-6);
    ZONES.into_iter().map(|number| format!("z{number}")).find(is_it)
}

/// The radius of a zone \[mm\], by its name in small letters.
pub(crate) fn zone_mm(name: &str) -> Option<f32> {
    numbered(name, 'z', &ZONES).map(|number| if number == 0 { 0.3 } else { f32::from(number) })
}

/// Checks that a name, in small letters, is the name of a speed.
pub(crate) fn is_speed(name: &str) -> bool {
    name == "vmax" || numbered(name, 'v', &SPEEDS).is_some()
}

#[cfg(test)]
mod tests {
    use super::{is_taken, *};

    #[test]
    fn modules_are_known_by_name_or_text() {
        let is_in = |name: &str, text: &str| {
            let (name, text) = (name.to_owned(), text.to_owned());
            Rapid.is_in(&ProgramFile { name, text })
        };
        assert!(is_in("Wash.MOD", "") && is_in("wash.sysx", ""));
        assert!(is_in("wash.txt", "\n! a note\n  Module wash\n"));
        assert!(is_in("wash.txt", "%%%\n  VERSION:1\n%%%\n"));
        assert!(!is_in("wash.txt", "") && !is_in("wash.script", "def wash():\n  MODULE = 1\n"));
        assert!(!is_in("wash.yaml", "é: MODULE a"));
    }

    #[test]
    fn rejects_keywords_and_names_of_the_controller() {
        assert!(
            ["Proc", "z5", "V100", "wobj0", "MoveL", "JointTarget", "fine"]
                .into_iter()
                .all(is_taken)
        );
        assert!(!["pwWash3", "kitchen", "z3", "v05", ""].into_iter().any(is_taken));
    }

    #[test]
    fn knows_zones_and_speeds_by_name() {
        let zones = [0.005, 0.000_3, 0.004, f64::NAN].map(zone_named);
        assert_eq!(
            zones.each_ref().map(Option::as_deref),
            [Some("z5"), Some("z0"), None, None]
        );
        assert_eq!((zone_mm("z5"), zone_mm("z3")), (Some(5.0), None));
        let speeds = ["v100", "vmax", "v7000", "v05", "v7", "v"].map(is_speed);
        assert_eq!(speeds, [true, true, true, false, false, false]);
    }
}
