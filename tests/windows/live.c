/* live PORT: opens a real card, PORT such as port:inpoutx64.dll,offset=0x300, sets its ranges and prints the last
 * error. */
#include <mcx314lib.h>
#include <stdio.h>

int main(int count, char** words) {
    if (count != 2 || mcx314_open(words[1], NULL) < 0) {
        printf("%s\n", count == 2 ? mcx314_last_error() : "usage: live PORT");
        return 1;
    }
    SetRange(800000);
    SetMaxSpeed(80000);
    printf("LP %d, error '%s'\n", (int)ReadLPS(1), mcx314_last_error());
    return 0;
}
