
  PROC pwCheckShare()
    IF pwShare>0 AND pwShare<=pwShareMost THEN
      pwRunning:=pwShare;
      RETURN;
    ENDIF
    TPErase;
    TPWrite "pwShare is "+ValToStr(pwShare)+".";
    TPWrite "It must be above 0 and at most "+ValToStr(pwShareMost)+". Nothing has moved.";
    EXIT;
  ENDPROC

  PROC pwCheckStart()
    VAR jointtarget now;
    now:=CJointT();
    pwCheckJoint 1,now.robax.rax_1,pwStart.robax.rax_1;
    pwCheckJoint 2,now.robax.rax_2,pwStart.robax.rax_2;
    pwCheckJoint 3,now.robax.rax_3,pwStart.robax.rax_3{with_joint_2};
    pwCheckJoint 4,now.robax.rax_4,pwStart.robax.rax_4;
    pwCheckJoint 5,now.robax.rax_5,pwStart.robax.rax_5;
    pwCheckJoint 6,now.robax.rax_6,pwStart.robax.rax_6;
  ENDPROC

  PROC pwCheckJoint(num joint,num found,num expected)
    IF Abs(found-expected)<={start_within_deg} RETURN;
    TPErase;
    TPWrite "Joint "+NumToStr(joint,0)+" stands at "+NumToStr(found,4)+" deg.";
    TPWrite "The program starts at "+NumToStr(expected,4)+" deg.";
    TPWrite "That is more than {start_within_deg} deg away: jog the arm there.";
    TPWrite "Then set the program pointer to main. Nothing has moved.";
    EXIT;
  ENDPROC
