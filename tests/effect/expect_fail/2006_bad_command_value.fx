// expect: 2006_bad_command_value.fx(4,31): error TG2006: 'Colour' is not a value of Clear; write Color, Color0 to Color7, Depth or Stencil
technique T
{
    pass P < string Script = "Clear=Colour; Draw=Geometry;"; > { }
}
