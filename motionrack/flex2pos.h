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
 * The functions access the card only through its registers. Before a successful Init, and for a null pointer, they
 * write nothing and return 0. A rack and the objects opened on it belong to one thread at a time. */
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

/* Creates an object for an IOFLEX02 card on the rack's bus; Init selects the card. Close it before the rack. On failure
 * *flex is NULL. MR_BAD_CALL (null; the rack has no such card). */
MR_API int flex2pos_open(mr_rack* rack, flex2pos** flex);

/* Closes and frees the object. Has no effect for NULL or in a call-back during a call with this object. */
MR_API void flex2pos_close(flex2pos* flex);

/* Results of Init and Configure. The names are the source's; the numbers are Motionrack's. */
enum { Flex_Ok = 0, Flex_ErrCfg = 1, Flex_ErrDevice = 2, Flex_ErrProject = 3 };

/* Selects the card at the base address, loads its array and checks the project. Uses the image of the card in the rack
 * file, or else the built-in image. Advances the rack's virtual time by seconds. Returns the result, which Result
 * keeps; in a call-back of the rack Flex_ErrDevice, and nothing is done. */
MR_API int flex2pos_Init(flex2pos* flex, uint16_t Addr);

/* First step of an Init with a custom image: sets the base address only, as the source's object tIOFlex02 does. Result
 * is Flex_ErrDevice until Configure. MR_BAD_CALL (null), MR_REFUSED (called by a call-back of the rack). */
MR_API int flex2pos_set_base_address(flex2pos* flex, uint16_t Addr);

/* Second step: loads this image, made by flex2pos_image_make or `motionrack image make`; NULL: the image of Init.
 * Returns the result, which Result keeps: Flex_ErrCfg if the image is truncated, damaged or not an image,
 * Flex_ErrProject if it has another project or version. In a call-back of the rack Flex_ErrDevice, and nothing is
 * done. */
MR_API int flex2pos_Configure(flex2pos* flex, const uint8_t* image, size_t size);

/* Return the last result, and its sentence (empty for Flex_Ok), valid until the next call with this object. */
MR_API int flex2pos_Result(const flex2pos* flex);
MR_API const char* flex2pos_why(const flex2pos* flex);

/* Returns the version of the project in the array. */
MR_API uint8_t flex2pos_GetIdent(flex2pos* flex);

/* ---- Time and positions ---- */

/* Returns the card's time in ticks of 1.2 us, 0 to 16,777,215; wraps after 20.1 s. */
MR_API int32_t flex2pos_ReadTime(flex2pos* flex);

/* Returns the card's time and clears it in the same access. */
MR_API int32_t flex2pos_ReadTimeClr(flex2pos* flex);

/* Returns the position of axis 0 to 3 in counts from its calibration, -8,388,608 to 8,388,607; 0 for other axes. */
MR_API int32_t flex2pos_ReadPosition(flex2pos* flex, int axis);

/* Reads the time, clears it, and reads the positions of the four axes, all at one instant. Each pointer may be NULL. */
MR_API void flex2pos_ReadTimeClrPosition(flex2pos* flex, int32_t* Time, int32_t Pos[4]);

/* ---- Inputs and outputs ---- */

/* Write the low and the high 8 outputs of connector X5. */
MR_API void flex2pos_WriteOutL(flex2pos* flex, uint8_t Data);
MR_API void flex2pos_WriteOutH(flex2pos* flex, uint8_t Data);

/* Return the 16 inputs, from bit 0 on A, B, Z, Cal of an axis: L of axes 0 and 1, H of axes 2 and 3. */
MR_API uint8_t flex2pos_ReadInL(flex2pos* flex);
MR_API uint8_t flex2pos_ReadInH(flex2pos* flex);

/* ---- Calibration ---- */

/* Commands: no operation; set the position to 0 immediately; at the next index; at the next index after a rising edge
 * of the axis' calibration input. */
enum { cNop = 0, cRes = 1, cResNm = 2, cResNmSig = 3 };

/* States: not calibrated; calibrated. */
enum { sNotCal = 0, sCal = 1 };

/* Writes one command per axis, in one access. Writes nothing if a command is invalid. */
MR_API void flex2pos_WriteCmd(flex2pos* flex, int Cmd0, int Cmd1, int Cmd2, int Cmd3);

/* Extension: writes a command for one axis 0 to 3; pending calibrations of the other axes continue. WriteCmd cannot do
 * this: cNop ends a pending calibration, and every other command restarts it. Writes nothing if Axis or Cmd is out of
 * range. */
MR_API void flex2pos_WriteCmdAxis(flex2pos* flex, int axis, int Cmd);

/* Reads the states of the four axes. */
MR_API void flex2pos_ReadSts(flex2pos* flex, int Sts[4]);

/* ---- Configuration images ---- */

/* Payload of an image of the project "position": the counting mode of each axis, a word MODE, low byte first. The
 * payload may have up to 131,072 bytes; bytes after the first 8 are ignored. */
enum { flex2pos_payload = 8 };

/* Creates an image from a project name of 1 to 16 characters (null: "position"), the ident that GetIdent returns (Init
 * accepts 25h) and a payload (null: 8 zeros). *size: capacity on entry, image size on return; a buffer that is too
 * small is not written, nor is a null image. MR_BAD_CALL (null size; buffer too small), MR_REFUSED (name or payload out
 * of range). */
MR_API int flex2pos_image_make(const char* project, uint8_t ident, const uint8_t* payload, size_t payload_size,
                               uint8_t* image, size_t* size);

/* Returns the result of Configure with this image, without a card: Flex_Ok, Flex_ErrCfg or Flex_ErrProject;
 * mr_last_error() returns the sentence. */
MR_API int flex2pos_image_check(const uint8_t* image, size_t size);

#ifdef __cplusplus
}
#endif

#endif
