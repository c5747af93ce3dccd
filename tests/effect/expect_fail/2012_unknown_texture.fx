// expect: 2012_unknown_texture.fx(3,32): error TG2012: unknown texture 'gSkinMpa'; did you mean 'gSkinMap'?
Texture2D gSkinMap;
SamplerState gSkin { Texture = <gSkinMpa>; Filter = MIN_MAG_MIP_LINEAR; };
