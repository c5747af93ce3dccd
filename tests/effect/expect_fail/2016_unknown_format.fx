// expect: 2016_unknown_format.fx(2,45): error TG2016: unknown format 'A16B16G16R16E'; did you mean 'A16B16G16R16'?
Texture2D gMap : RENDERCOLORTARGET < string Format = "A16B16G16R16E"; >;
