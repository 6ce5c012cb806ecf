//! Names that RAPID or its controllers have given: a program must not name anything by them.

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

/// Whether a name is a keyword or the controller's own, in any case of letters.
pub(super) fn is_taken(name: &str) -> bool {
    let (capitals, small) = (name.to_ascii_uppercase(), name.to_ascii_lowercase());
    KEYWORDS.split_ascii_whitespace().any(|word| word == capitals)
        || CONTROLLER.split_ascii_whitespace().any(|word| word == small)
        || super::zone::zone_mm(&small).is_some()
        || super::zone::is_speed(&small)
}

#[cfg(test)]
mod tests {
    use super::is_taken;

    #[test]
    fn keywords_and_names_of_the_controller_are_taken() {
        assert!(
            ["Proc", "z5", "V100", "wobj0", "MoveL", "JointTarget", "fine"]
                .into_iter()
                .all(is_taken)
        );
        assert!(!["pwWash3", "kitchen", "z3", "v05", ""].into_iter().any(is_taken));
    }
}
