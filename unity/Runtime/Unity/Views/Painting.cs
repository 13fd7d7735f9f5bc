using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Gives single objects a colour of their own without a material of their own.</summary>
    internal static class Painting
    {
        // The built-in pipeline's shaders and those of the scriptable ones name the colour differently.
        private static readonly int BuiltIn = Shader.PropertyToID("_Color");
        private static readonly int Scriptable = Shader.PropertyToID("_BaseColor");

        private static MaterialPropertyBlock block;

        internal static void Paint(this Renderer renderer, Color color)
        {
            block = block ?? new MaterialPropertyBlock();
            renderer.GetPropertyBlock(block);
            block.SetColor(BuiltIn, color);
            block.SetColor(Scriptable, color);
            renderer.SetPropertyBlock(block);
        }
    }
}
