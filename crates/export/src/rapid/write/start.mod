  ! The tool: its tip from the flange, and its load.
  PERS tooldata pwTool:={tool};
  ! Share of the plan's speed; every time is divided by it. It may be lowered
  !   here or on the pendant.
  PERS num pwShare:={share};
  ! What it was judged for: it may be no more. For a faster program export
  !   another one.
  CONST num pwShareMost:={share};
  ! The share of this run, which does not change before it ends.
  VAR num pwRunning:=0;
  ! Where the arm must stand.
  CONST jointtarget pwStart:={start};
{zone}
  ! The whole plan, once.
  PROC main()
    pwCheckShare;
    pwCheckStart;
    ! To the start itself, which is {start_within_deg} deg away at most.
    MoveAbsJ pwStart\NoEOffs,v20,fine,pwTool\WObj:=wobj0;
{calls}    ! Also in continuous mode the plan is not run again by itself.
    EXIT;
  ENDPROC
