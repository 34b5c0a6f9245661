/* The program in the header comment of c.h, built against the installed package: X moves by 100 pulses. */
#include <motionrack/c.h>
#include <stdio.h>

int main(void) {
    mr_rack* rack = NULL;
    uint16_t low = 0;
    if (mr_rack_open("card.c1 = \"mcx314\"", &rack) != MR_OK) {
        fprintf(stderr, "%s\n", mr_last_error());
        return 1;
    }
    mr_write16(rack, "c1", 0x0e, 0);
    mr_write16(rack, "c1", 0x0c, 100);
    mr_write16(rack, "c1", 0x00, 0x0106);
    mr_write16(rack, "c1", 0x00, 0x0120);
    mr_advance_ns(rack, 1000000000);
    mr_write16(rack, "c1", 0x00, 0x0110);
    mr_read16(rack, "c1", 0x0c, &low);
    printf("LP %d\n", (int)low);
    mr_rack_close(rack);
    return 0;
}
