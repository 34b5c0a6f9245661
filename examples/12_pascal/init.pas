Uses
  uIOFlex2,
  uFlx2Pos;
Var
  MyIOFlexObj : tIOFlexPos;
Begin
  MyIOFlexObj.Init($2300{IOFlex02 base addr});
  If MyIOFlexObj.Result<>Flex_Ok then
    Write('Chyba inicializace desky: ', MyIOFlexObj.Result);
End.
