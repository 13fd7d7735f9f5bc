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
    }
}
