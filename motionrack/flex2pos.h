/* The unit uFlex2Pos in C: the IOFLEX02's function library under its source's names, on a rack of motionrack/c.h.
 *
 *     mr_rack *rack = NULL;
 *     flex2pos *flex = NULL;
 *     int32_t time, position[4];
 *     if (mr_rack_open("card.p1 = \"ioflex02\"", &rack) != MR_OK || flex2pos_open(rack, &flex) != MR_OK) {
 *         fprintf(stderr, "%s\n", mr_last_error());
 *         return 1;
 *     }
 *     if (flex2pos_Init(flex, 0x2300) != Flex_Ok) fprintf(stderr, "%s\n", flex2pos_why(flex));
 *     flex2pos_ReadTimeClrPosition(flex, &time, position);
 *
 * The functions talk to the card through its registers alone. As long as Init has not succeeded, and for a null
 * pointer, nothing is written and every function gives 0. A rack and what is opened on it belong to one thread at a
 * time. */
#ifndef MOTIONRACK_FLEX2POS_H
#define MOTIONRACK_FLEX2POS_H

#include <motionrack/c.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct flex2pos flex2pos;

/* ---- The object ---- */

/* Makes an object for the IOFLEX02 cards on the rack's bus; which of them it is for, Init says. Close it before the
 * rack. *flex is set to NULL if it fails. MR_BAD_CALL (null; the rack has no such card). */
MR_API int flex2pos_open(mr_rack* rack, flex2pos** flex);

/* NULL is allowed. */
MR_API void flex2pos_close(flex2pos* flex);

/* Outcomes of Init; the source names them, the numbers are chosen. */
enum { Flex_Ok = 0, Flex_ErrCfg = 1, Flex_ErrDevice = 2, Flex_ErrProject = 3 };

/* Looks for the card at the base address, loads its array with the image that is built in, checks the project. Takes
 * seconds of the rack's time. Gives the outcome, which Result keeps. */
MR_API int flex2pos_Init(flex2pos* flex, uint16_t Addr);

/* The last outcome, and its sentence (empty for Flex_Ok), which is good until the next call with this object. */
MR_API int flex2pos_Result(const flex2pos* flex);
MR_API const char* flex2pos_why(const flex2pos* flex);

/* Version of the project in the array. */
MR_API uint8_t flex2pos_GetIdent(flex2pos* flex);

/* ---- Time and positions ---- */

/* The card's time in ticks of 1.2 us, 0 to 16,777,215; it goes round after 20.1 s. */
MR_API int32_t flex2pos_ReadTime(flex2pos* flex);

/* The same, and the time is cleared in the same access. */
MR_API int32_t flex2pos_ReadTimeClr(flex2pos* flex);

/* Position of an axis 0 to 3 in counts from its calibration, -8,388,608 to 8,388,607; 0 for another number. */
MR_API int32_t flex2pos_ReadPosition(flex2pos* flex, int axis);

/* Time, which is cleared, and the positions of the four axes, all of one instant. Either pointer may be NULL. */
MR_API void flex2pos_ReadTimeClrPosition(flex2pos* flex, int32_t* Time, int32_t Pos[4]);

/* ---- Inputs and outputs ---- */

/* Low and high 8 outputs of connector X5. */
MR_API void flex2pos_WriteOutL(flex2pos* flex, uint8_t Data);
MR_API void flex2pos_WriteOutH(flex2pos* flex, uint8_t Data);

/* Low and high 8 inputs. */
MR_API uint8_t flex2pos_ReadInL(flex2pos* flex);
MR_API uint8_t flex2pos_ReadInH(flex2pos* flex);

/* ---- Calibration ---- */

/* Commands: none; the position becomes 0 at once; at the next index; at the next index after a rising edge of the axis'
 * calibration input. */
enum { cNop = 0, cRes = 1, cResNm = 2, cResNmSig = 3 };

/* Statuses: waits for its calibration; calibrated. */
enum { sNotCal = 0, sCal = 1 };

/* A command for each axis, together. Nothing is written if one of them is none of these. */
MR_API void flex2pos_WriteCmd(flex2pos* flex, int Cmd0, int Cmd1, int Cmd2, int Cmd3);

/* The statuses of the four axes. */
MR_API void flex2pos_ReadSts(flex2pos* flex, int Sts[4]);

#ifdef __cplusplus
}
#endif

#endif
