/* Moves axis X of a real card and prints its position: live_program PORT, e.g. port:/dev/port,offset=0x300,width=8. */
#include <mcx314lib.h>
#include <stdio.h>

int main(int count, char** words) {
    int64_t begun;
    if (count != 2 || mcx314_open(words[1], NULL) < 0) {
        fprintf(stderr, "%s\n", count == 2 ? mcx314_last_error() : "usage: live_program PORT");
        return 1;
    }
    SetRange(800000);
    TCurve_F(1, 100, 2000, 400, 2000);
    begun = mcx314_now_us();
    if (mcx314_wait(1, 10000) < 0 || mcx314_peek("x.LP", &begun) == 0) {
        fprintf(stderr, "%s\n", mcx314_last_error());
        return 1;
    }
    printf("X stands at LP %d after %s\n", (int)ReadLPS(1), mcx314_now_us() - begun > 100000 ? "its time" : "no time");
    printf("%s\n", mcx314_last_error());
    return mcx314_close(1) == 0 ? 0 : 1;
}
