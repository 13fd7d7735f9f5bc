namespace UnityEngine.UIElements
{
    public class VisualElement { }
}
