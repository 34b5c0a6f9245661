*      WHAT THE LISTING TAKES FROM THE LIBRARY OS40BJ.M4DEFLB/O OF OS8, WHICH IS NOT PRINTED.
*      THE NAMES ARE THE LISTING'S; THE NUMBERS ARE CHOSEN.
*
*      SVC 1: READ AND WRITE. THE PLACES IN THE BLOCK ARE THOSE OF S1PRINT IN THE LISTING.
*
S0.FC     =       0                       FUNCTION, A BYTE
S1.LU     =       2                       LOGICAL UNIT
S1.BAD    =       4                       BUFFER ADDRESS
S1.BSZ    =       6                       BUFFER SIZE
S1.ROW    =       10                      CURSOR ADDRESS
S1.COL    =       12
*
S1F.READ  =       1
S1F.WRIT  =       2
S1F.FASC  =       4                       FORMATTED ASCII
S1F.IBIN  =       8                       BINARY
S1F.RND   =       128                     RANDOM: AT THE CURSOR ADDRESS
*
*      SVC 6: JOBS. SVC 7: FILES.
*
S6F.CAN   =       1                       CANCEL
S7F.ASGN  =       1                       ASSIGN
S7.FD     =       4                       ADDRESS OF THE FILE DESCRIPTOR
