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
 * pointer, nothing is written and every function gives 0. A rack and the objects opened on it belong to one thread at a
 * time. */
#ifndef MOTIONRACK_FLEX2POS_H
#define MOTIONRACK_FLEX2POS_H

#include <motionrack/c.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct flex2pos flex2pos;

/* Version of the unit in BCD, 2.51, and as text with its date. */
enum { cVerNo = 0x0251 };
static const char cVer[] = "02.51, 07.08.2003";

/* ---- The object ---- */

/* Makes an object for the IOFLEX02 cards on the rack's bus; which of them it is for, Init says. Close it before the
 * rack. *flex is set to NULL if it fails. MR_BAD_CALL (null; the rack has no such card). */
MR_API int flex2pos_open(mr_rack* rack, flex2pos** flex);

/* NULL is allowed. */
MR_API void flex2pos_close(flex2pos* flex);

/* Outcomes of Init and Configure; the source names them, the numbers are chosen. */
enum { Flex_Ok = 0, Flex_ErrCfg = 1, Flex_ErrDevice = 2, Flex_ErrProject = 3 };

/* Looks for the card at the base address, loads its array and checks the project: with the image that the rack file
 * gives the card, else with the one that is built in. Takes seconds of the rack's time. Gives the outcome, which Result
 * keeps. */
MR_API int flex2pos_Init(flex2pos* flex, uint16_t Addr);

/* Init in two steps, for a custom image. First the base address alone, which is what the source's object
 * tIOFlex02 does; Result is Flex_ErrDevice until Configure. MR_BAD_CALL (null). */
MR_API int flex2pos_set_base_address(flex2pos* flex, uint16_t Addr);

/* Then the rest, with this image, as flex2pos_image_make and motionrack image make write it; with a null pointer that
 * of Init. Gives the outcome, which Result keeps: Flex_ErrCfg for an image that is cut short, damaged or none,
 * Flex_ErrProject for one of another project or version. */
MR_API int flex2pos_Configure(flex2pos* flex, const uint8_t* image, size_t size);

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

/* Low and high 8 of the 16 inputs: from bit 0 on A, B, Z and Cal of axes 0 and 1, and of axes 2 and 3. */
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

/* Ours: a command for one axis 0 to 3; the others keep what they wait for. WriteCmd cannot do that: cNop ends what an
 * axis waits for, and any other command restarts it. Nothing is written if Axis or Cmd is out of range. */
MR_API void flex2pos_WriteCmdAxis(flex2pos* flex, int axis, int Cmd);

/* The statuses of the four axes. */
MR_API void flex2pos_ReadSts(flex2pos* flex, int Sts[4]);

/* ---- Configuration images ---- */

/* How the axes count, the payload of an image of the project "position": a word MODE for each, its low byte first. The
 * payload may go on after these 8 bytes, to 131,072; what follows is not looked at. */
enum { flex2pos_payload = 8 };

/* Makes an image: project of 1 to 16 characters (null: "position"), ident as GetIdent gives it (25h is the one that
 * Init takes), payload (null: 8 zeros). *size is how many bytes there is room for, and then how many the image has;
 * where the room is too small, or image is null, it is not written. MR_BAD_CALL (null size; no room), MR_REFUSED (name
 * or payload out of range). */
MR_API int flex2pos_image_make(const char* project, uint8_t ident, const uint8_t* payload, size_t payload_size,
                               uint8_t* image, size_t* size);

/* What Configure would come to with this image, without a card: Flex_Ok, Flex_ErrCfg or Flex_ErrProject; mr_last_error
 * then has the sentence. */
MR_API int flex2pos_image_check(const uint8_t* image, size_t size);

#ifdef __cplusplus
}
#endif

#endif
