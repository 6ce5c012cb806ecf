//! Data of a program, its `main`, and what it checks before it moves.

use super::line::{Lines, number};
use super::motion::{Routine, target, zone};
use super::names::{MOST, RUNNING, SHARE};
use super::tool::tooldata;
use crate::program::{Program, START_WITHIN_DEG};
use platewash_kinematics::JointVector;

/// The tool, the share of the speed, the start, and a zone that has no name.
pub fn data(lines: &mut Lines, program: &Program<'_>) {
    lines.comment(1, "The tool: its tip from the flange, and its load.");
    lines.line(1, &format!("PERS tooldata pwTool:={};", tooldata(program.tool())));
    lines.comment(
        1,
        "Share of the plan's speed; every time is divided by it. It may be lowered here or on the pendant.",
    );
    // The shortest decimal of a single: what the controller reads is what was meant.
    let share = program.speed_share as f32;
    lines.line(1, &format!("PERS num {SHARE}:={share};"));
    lines.comment(
        1,
        "What it was judged for: it may be no more. For a faster program export another one.",
    );
    lines.line(1, &format!("CONST num {MOST}:={share};"));
    lines.comment(1, "The share of this run, which does not change before it ends.");
    lines.line(1, &format!("VAR num {RUNNING}:=0;"));
    lines.comment(1, "Where the arm must stand.");
    let start = program
        .points
        .first()
        .map_or_else(JointVector::zeros, |point| point.q_rad);
    lines.line(1, &format!("CONST jointtarget pwStart:={};", target(&start)));
    if let Some(radius_mm) = zone(program).radius_mm() {
        let [tip, more, angle] = [radius_mm, 1.5 * radius_mm, 0.15 * radius_mm].map(|value| number(value, 6));
        lines.comment(1, "Corners at targets that are no stops.");
        lines.line(
            1,
            &format!("CONST zonedata pwZone:=[FALSE,{tip},{more},{more},{angle},{more},{angle}];"),
        );
    }
}

/// The procedure that runs everything, once.
pub fn main(lines: &mut Lines, routines: &[Routine]) {
    lines.comment(1, "The whole plan, once.");
    lines.line(1, "PROC main()");
    lines.line(2, "pwCheckShare;");
    lines.line(2, "pwCheckStart;");
    lines.comment(
        2,
        &format!("To the start itself, which is {START_WITHIN_DEG} deg away at most."),
    );
    lines.line(2, "MoveAbsJ pwStart\\NoEOffs,v20,fine,pwTool\\WObj:=wobj0;");
    for routine in routines {
        lines.line(2, &format!("{};", routine.name()));
    }
    lines.comment(2, "Also in continuous mode the plan is not run again by itself.");
    lines.line(2, "EXIT;");
    lines.line(1, "ENDPROC");
}

/// What is checked before the arm moves. Where a check fails the program ends: `EXIT` cannot be passed by starting it again, `Stop` can.
pub fn checks(lines: &mut Lines) {
    lines.blank();
    lines.line(1, "PROC pwCheckShare()");
    lines.line(2, &format!("IF {SHARE}>0 AND {SHARE}<={MOST} THEN"));
    lines.line(3, &format!("{RUNNING}:={SHARE};"));
    lines.line(3, "RETURN;");
    lines.line(2, "ENDIF");
    lines.line(2, "TPErase;");
    lines.line(2, &format!("TPWrite \"{SHARE} is \"+ValToStr({SHARE})+\".\";"));
    lines.line(
        2,
        &format!("TPWrite \"It must be above 0 and at most \"+ValToStr({MOST})+\". Nothing has moved.\";"),
    );
    lines.line(2, "EXIT;");
    lines.line(1, "ENDPROC");
    lines.blank();
    lines.line(1, "PROC pwCheckStart()");
    lines.line(2, "VAR jointtarget now;");
    lines.line(2, "now:=CJointT();");
    for joint in 1..=6 {
        lines.line(
            2,
            &format!("pwCheckJoint {joint},now.robax.rax_{joint},pwStart.robax.rax_{joint};"),
        );
    }
    lines.line(1, "ENDPROC");
    lines.blank();
    lines.line(1, "PROC pwCheckJoint(num joint,num found,num expected)");
    lines.line(2, &format!("IF Abs(found-expected)<={START_WITHIN_DEG} RETURN;"));
    lines.line(2, "TPErase;");
    lines.line(
        2,
        "TPWrite \"Joint \"+NumToStr(joint,0)+\" stands at \"+NumToStr(found,4)+\" deg.\";",
    );
    lines.line(2, "TPWrite \"The program starts at \"+NumToStr(expected,4)+\" deg.\";");
    lines.line(
        2,
        &format!("TPWrite \"That is more than {START_WITHIN_DEG} deg away: jog the arm there.\";"),
    );
    lines.line(
        2,
        "TPWrite \"Then set the program pointer to main. Nothing has moved.\";",
    );
    lines.line(2, "EXIT;");
    lines.line(1, "ENDPROC");
}
