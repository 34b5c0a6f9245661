/* Stub of InpOut32 (inpoutx64.dll): all ports read 0, as those of an idle chip; each access prints a line to stderr.
 * PORT_DRIVER=off: acts as if its driver were not installed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHOWN __declspec(dllexport)

SHOWN int __stdcall IsInpOutDriverOpen(void) {
    const char* driver = getenv("PORT_DRIVER");
    return driver == NULL || strcmp(driver, "off") != 0;
}

SHOWN unsigned char __stdcall DlPortReadPortUchar(unsigned short port) {
    fprintf(stderr, "read8 %04x\n", port);
    return 0;
}

SHOWN void __stdcall DlPortWritePortUchar(unsigned short port, unsigned char value) {
    fprintf(stderr, "write8 %04x %02x\n", port, value);
}

SHOWN unsigned short __stdcall DlPortReadPortUshort(unsigned short port) {
    fprintf(stderr, "read16 %04x\n", port);
    return 0;
}

SHOWN void __stdcall DlPortWritePortUshort(unsigned short port, unsigned short value) {
    fprintf(stderr, "write16 %04x %04x\n", port, value);
}
