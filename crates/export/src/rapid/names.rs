//! Names that RAPID has already: keywords, the controller's own, zones and speeds.

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
    use super::*;

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
