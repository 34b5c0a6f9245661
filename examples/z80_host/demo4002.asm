DEMO4002  PROG    ** DEMONSTRATION FOR 4002 BOARD. **
*
*
*      VER 1.00  CE      84-03-27
*      VER 1.01  TH      84-11-27
*
*      DEMONSTRATION PROGRAM FOR 4002 BOARD
*      RUNNING UNDER OS8 WITH FLAG TEST.
*
*      CARD ADDRESS SHOULD BE 15Q.
*
*      RADIX 16
*      SQUEZ
*      EJECT
*
*      START UP.
*
START     =       *
          CALL    INIT
MAINLOOP  =       *
          LDI     HL,63*256+240           SET MAX SPEED.
          CALL    MAXSPEED
          LI      A,1
          CALL    STORESLO                STORE SLOPE TYPE 1.
          LDI     HL,1000                 DO POSITIONING TO POS 1000.
          CALL    GOPOSIT
          LDI     HL,C2:'L'               TURN LOCK ON.
          CALL    OUTSTROB
          CALL    QUIT                    WAIT FOR USER KEY.
          LDI     HL,C2:'M'               SET MANUAL MODE.
          CALL    OUTSTROB                AND LOCK OFF TOO.
          LI      A,2                     STORE SLOPE TYPE 2.
          CALL    STORESLO
          LDI     HL,63*256+240           SET MAX SPEED.
          CALL    MAXSPEED
          LDI     HL,500                  GO TO POSITION 500
          CALL    GOPOSIT
          CALL    QUIT
          LDI     HL,63*256               SET NEW MAX SPEED.
          CALL    MAXSPEED
          LDI     HL,0
          CALL    GOPOSIT                 BACK TO POSITION 0.
          CALL    QUIT
          JMP     MAINLOOP
          EJECT
*
*      DO POSITIONING TO REQUESTED POSITION IN HL.
*
GOPOSIT   =       *
          PUSH    HL
          LDI     HL,C2:'P'               ABSOLUTE POSITIONING.
          CALL    OUTSTROB
          LDI     HL,DATA:0               0 IN LOW BYTE OF ARGUMENT.
          CALL    OUTSTROB
          POP     HL
          PUSH    HL                      MEDIMUM BYTE OF ARGUMENT.
          LI      H,DATA
          CALL    OUTSTROB
          POP     HL
          LR      L,H                     MOST SIGNIFICANT BYTE OF ARGUMENT.
          LI      H,DATA
          CALL    OUTSTROB
          LDI     HL,C4:32+1              ENABLE IN POSITION AND END-STOP EVENTS.
          CALL    OUTSTROB
          LI      H,DATA
          CALL    INSTROB                 DUMMY READ TO GET RID OF OLD EVENETS.
          LDI     HL,C2:'G'               SAY GO.
          CALL    OUTSTROB
GOLOOP    =       *
          INP     STAT
          NI      2                       WAIT FOR EVENT.
          JZS     GOLOOP
*
          LDI     HL,C4:32+1              EVENT OCCURED,READ EVENT WORD.
          CALL    OUTSTROB
          LI      H,DATA
          CALL    INSTROB
          TBT     32,A                    CHECK ENDSTOP.
          JZS     NOENDSTO
*
          PUSH    A                       SAVE FOR IN POSITION RESEARCH.
          INP     STAT                    WHAT KIND OF END-STOP?
          LA      HL,S.LEFTM
          TBT     64,A
          CNZ     PRINTSTR
          LA      HL,S.RIGHTM
          TBT     32,A
          CNZ     PRINTSTR
          TBT     16,A
          LA      HL,S.EMERG
          CNZ     PRINTSTR
          POP     A
NOENDSTO  =       *
          NI      1                       IN POSITION?
          JZS     GOLOOP                  NO !
*
          RET
          EJECT
*
*      SET MAXIMUM SPEED.
*
MAXSPEED  =       *
          PUSH    HL
          LDI     HL,C2:'R'               GIVE COMMAND.
          CALL    OUTSTROB
          POP     HL
          PUSH    HL
          LI      H,DATA
          CALL    OUTSTROB                WRITE ARGUMENT.
          POP     HL
          LR      L,H
          LI      H,DATA
          CALL    OUTSTROB
          RET
          EJECT
*
*
*
QUIT      =       *
          LA      HL,S.CLEAR
          CALL    PRINTSTR                CLEAR SCREEN.
          LA      HL,S.INPOS
          CALL    PRINTSTR                SAY 'IN POSITION,'
          SVC     1,S1RDKEY               READ ONE KEY FROM KEYBOARD.
          LA      HL,S.CLEAR
          CALL    PRINTSTR
          RET
          EJECT
*
*
*
WAITRDY   =       *
          PUSH    HL
          LDI     HL,10000                SET TIME OUT COUNTER.
WAITLOOP  =       *
          INP     STAT
          NI      128
          JNZS    WAITEXIT                UNIT READY.
*
          DECD    HL
          LR      A,L
          OR      H
          JNZS    WAITLOOP
*
WAITEXIT  =       *
          POP     HL
          RNZ                             EXIT IF NOT TIMEOUT.
          LA      HL,S.FATAL              FATAL ERROR,DEVICE NEVER READY.
          CALL    PRINTSTR
          SVC     6,S6CAN                 ABORT JOB !!!!!!!!!!!!!!!
          EJECT
*
*      STORE ACCECLARATION SLOPE.
*
STORESLO  =       *
*
*
*
          LDI     HL,C2:'S'
          CALL    OUTSTROB
          LI      C,1
STORE1    =       *
          LR      A,C
          CI      1
          LA      DE,SLOPEDEC             DECELERATING SLOPE?
          JZS     STORE2
*
          LA      DE,SLOPEACC
STORE2    =       *
          LI      B,24                    24 INTERVALS.
          LI      H,DATA
STORE3    =       *
          L       A,(DE)
          INCD    DE
          LR      L,A
          CALL    OUTSTROB                SPEED LOW BYTE.
          L       A,(DE)
          INCD    DE
          LR      L,A
          CALL    OUTSTROB                SPEED HIGH BYTE.
          LI      L,0
          CALL    OUTSTROB                POSITION LOW BYTE = 0.
          L       A,(DE)
          INCD    DE
          LR      L,A
          CALL    OUTSTROB                POSITION MEDIUM BYTE.
          L       A,(DE)
          INCD    DE
          LR      L,A
          CALL    OUTSTROB                POSITION HIGH BYTE.
          DJNZ    STORE3                  LOOP ALL 24 INTERVALS.
*
          INCR    C
          LI      A,3
          CR      C                       BOTH SLOPES, DEC AND ACC.
          JNZS    STORE1
*
          LDI     HL,C2:'O'               REGULATION ON.
          CALL    OUTSTROB
          RET
*
*
*
SLOPEDEC  =       *
          DA      14000,1,14500,6,15002,8,15216,15,15678,30,16016,35
          DA      16144,40,16262,45,16278,50,16288,60,16298,70,16304,85
          DA      16312,100,16317,115,16322,130,16326,145,16330,160
          DA      16332,180,16334,200,16336,225,16338,250,16340,285
          DA      16342,320,16344,370
SLOPEACC  =       *
          DA      14000,1,14500,12,15402,16,15682,22,15778,30,15900,35
          DA      16000,40,16262,50,16284,60,16292,70,16298,80,16304,105
          DA      16312,130,16316,150,16322,180,16326,215,16330,250
          DA      16332,290,16334,330,16336,365,16338,400,16340,450
          DA      16342,500,16344,600
          EJECT
*
*      SOME HELP ROUTINES.
*
OUTSTROB  =       *
          PUSH    BC
          PUSH    HL
          CALL    WAITRDY                 DEVICE MUST BE READY.
          POP     HL
          LR      C,H
          OUTR    L
          POP     BC
          RET
*
*
*
INSTROB   =       *
          PUSH    BC
          PUSH    HL
          CALL    WAITRDY                 DEVICE MUST BE READY BEFORE READING.
          POP     HL
          LR      C,H
          INPR    A
          POP     BC
          RET
          EJECT
*
*      INIT SOME PARAMETERS.
*
INIT      =       *
          SVC     7,S7ASGCON              ASSIGN CONSOLE.
          SVC     1,S1PRINT               CLEAR SCREEN.
          LI      A,13
          OUT     CS                      DO CARD SELECT.
          LDI     HL,C2:'I'               INITIALIZE BOARD.
          CALL    OUTSTROB
          LDI     HL,C2:'D'               SET UP MAX DEVIATION FOR LOCK FUNCTION.
          CALL    OUTSTROB
          LDI     HL,DATA:25              ALLOW 25 PULSES BEFORE REPOSITIONING.
          CALL    OUTSTROB
          LDI     HL,DATA:0
          CALL    OUTSTROB
          CALL    OUTSTROB
          RET
          EJECT
*
*      PRINT ROUTINE.
*
PRINTSTR  =       *
          L       A,(HL)
          ST      A,S1PRINT+S1.BSZ        SET UP LENGTH.
          INCD    HL
          STD     HL,S1PRINT+S1.BAD
          LI      A,S1F.WRIT+S1F.RND+S1F.FASC RANDOM BIT FOR CURSOR ADDRESSING.
          ST      A,S1PRINT+S0.FC
          SVC     1,S1PRINT
          RET
*
S1PRINT   =       *
          DA      S1F.WRIT+S1F.IBIN+S1F.RND CURSOR ADDRESSING.
          DA      1                       LU.
          DA      FFSTR
          DA      1                       LENGTH.
          DA      0                       SIZE.
          DA      800AH,8014H             CURSOR ADDRESS.
*
FFSTR     DB      26                      CLEAR SCREEN FOR ADM3A.
          EJECT
*
*      SOME SVC DATA AND OTHER IMPORTANT STUFF.
*
DATA      =       0
STAT      =       1
CS        =       1
C1        =       2
C2        =       3
C3        =       4
C4        =       5
*
S7ASGCON  DA      S7F.ASGN,1,CONFD,0,0,0,0,0
CONFD     DB      'CON '
          DMB     24,' '
*
S1RDKEY   DA      S1F.READ+S1F.IBIN,1,READBUF,1,0,0,0,0
READBUF   DB      0
*
S6CAN     DA      S6F.CAN,0,0,0,0,0,0,0
*
S.CLEAR   DB      S.CLEARE-*-1
          DMB     20,' '
S.CLEARE  =       *
*
S.EMERG   DB      S.EMERGE-*-1
          DB      'EMERGENCY STOP.'
S.EMERGE  =       *
*
S.LEFTM   DB      S.LEFTME-*-1
          DB      'LEFT MARGIN.'
S.LEFTME  =       *
*
S.RIGHTM  DB      S.RIGHTE-*-1
          DB      'RIGHT MARGIN.'
S.RIGHTE  =       *
*
S.FATAL   DB      S.FATALE-*-1
          DB      'FATAL ERROR, UNIT NOT READY!!!!!!'
S.FATALE  =       *
*
S.INPOS   DB      S.INPOSE-*-1
          DB      'IN POSITION.'
S.INPOSE  =       *
          END     START
