using System;

namespace UnityEngine
{
    public struct Rect
    {
        public float x { readonly get; set; }
        public float y { readonly get; set; }
        public float width { readonly get; set; }
        public float height { readonly get; set; }

        public Rect(float x, float y, float width, float height)
        {
            this.x = x;
            this.y = y;
            this.width = width;
            this.height = height;
        }

        public float yMax => y + height;
        public readonly bool Contains(Vector2 point) => point.x >= x && point.x < x + width && point.y >= y && point.y < y + height;
        public override readonly string ToString() => FormattableString.Invariant($"(x:{x:F2}, y:{y:F2}, width:{width:F2}, height:{height:F2})");
    }
}
